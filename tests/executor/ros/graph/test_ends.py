"""Which ends of topics are shown."""

from __future__ import annotations

from types import SimpleNamespace

from executor.ros.graph.ends import shown_ends


def test_hidden_nodes_and_those_without_a_name_yet_are_left_out():
    ends = [SimpleNamespace(node_name=name) for name in ("talker", "_recorder", "_NODE_NAME_UNKNOWN_")]
    assert [end.node_name for end in shown_ends(ends)] == ["talker"]
