"""The state of a tree as data."""

from __future__ import annotations

import pytest

from tree_gardener import ManualClock, Status, Tree
from tree_gardener.swap import capture
from tree_gardener.swap.capturing import behaviour_of
from tree_gardener.swap.state import Due

TEXT = """<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main"><Sequence _bts_id="s"><Script _bts_id="c" code="x := 1"/>
    <SubTree ID="Inner" _bts_id="i" y="{x}" z="2"/></Sequence></BehaviorTree>
  <BehaviorTree ID="Inner">
    <Delay _bts_id="d" delay_msec="500"><AlwaysSuccess _bts_id="a"/></Delay></BehaviorTree>
</root>"""


def test_nodes_entries_and_timers_are_named_by_key():
    tree = Tree.from_xml(TEXT, clock=ManualClock(3.0))
    tree.tick_exactly_once()
    state = capture(tree)
    assert list(state.nodes) == [("s",), ("c",), ("i",), ("i", "d"), ("i", "a")]
    assert state.nodes[("s",)].memory == {"index": ("i",), "skips": (0, (("c",),))}
    assert state.nodes[("i", "d")].memory == {"is_over": False, "timer": Due(3.5, 0)}
    assert state.nodes[("i", "d")].status is Status.RUNNING
    assert state.nodes[("i",)].parent == ("s",)
    assert state.entries[()]["x"].value == 1
    assert state.entries[("i",)]["z"].value == 2
    assert state.remapped[("i",)] == {"y"}
    assert state.tick == 1
    assert behaviour_of(tree.nodes[0]) is None


def test_a_tick_in_progress_is_refused():
    tree = Tree.from_xml(TEXT, clock=ManualClock())
    errors = []

    def look(_node: object) -> None:
        with pytest.raises(RuntimeError, match="between two ticks") as caught:
            capture(tree)
        errors.append(caught)

    tree.add_hook(before=look, node=1)
    tree.tick_exactly_once()
    assert len(errors) == 1
