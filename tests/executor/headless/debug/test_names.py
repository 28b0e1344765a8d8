from __future__ import annotations

import pytest

from executor.headless.debug.names import UnknownNodeError, names_of, node_named, place_named
from tests.tree_gardener.debugging.trees import tree_of
from tree_gardener.debugging import nodes_at

SUB = '<BehaviorTree ID="Sub"><Leaf name="x.S"/></BehaviorTree>'


@pytest.fixture
def nodes():
    subs = '<SubTree ID="Sub" name="one"/><SubTree ID="Sub" name="two"/>'
    body = f'<Sequence name="all">{subs}<Leaf name="y.S"/></Sequence>'
    return tree_of(body, SUB).nodes


def test_a_name_is_a_number_a_path_a_name_or_a_type(nodes) -> None:
    assert [node_named(nodes, name).uid for name in ("#4", "4", "two/x.S", "y.S", "Sequence")] == [
        4,
        4,
        5,
        6,
        1,
    ]


def test_a_name_of_a_shared_block_means_all_instances_and_a_path_one(nodes) -> None:
    assert [node.uid for node in nodes_at(nodes, place_named(nodes, "x.S"))] == [3, 5]
    assert [node.uid for node in nodes_at(nodes, place_named(nodes, "two/x.S"))] == [5]
    assert place_named(nodes, "y.S").instance is None


def test_an_unknown_or_ambiguous_name_is_refused_with_what_there_is(nodes) -> None:
    with pytest.raises(UnknownNodeError, match="no node has the path, name or type 'z'"):
        node_named(nodes, "z")
    with pytest.raises(UnknownNodeError, match=r"2 nodes are called 'x.S': #3 one/x.S, #5 two/x.S; name one"):
        node_named(nodes, "x.S")
    with pytest.raises(UnknownNodeError, match="3 nodes are called 'Leaf'"):
        place_named(nodes, "Leaf")


def test_paths_and_names_are_completed(nodes) -> None:
    assert {"one/x.S", "x.S", "all"} <= set(names_of(nodes))
