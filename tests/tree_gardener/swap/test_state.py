"""The keys of nodes."""

from __future__ import annotations

from tree_gardener import Tree
from tree_gardener.swap.state import keys_of


def test_a_node_without_an_id_is_known_by_type_and_name_and_equal_ones_are_numbered():
    tree = Tree.from_xml(
        '<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence><AlwaysSuccess/><AlwaysSuccess name="ok"/>'
        '<AlwaysSuccess/><AlwaysFailure _bts_id="f"/></Sequence></BehaviorTree></root>'
    )
    assert list(keys_of(tree.nodes).values()) == [
        ("Sequence ",),
        ("AlwaysSuccess ",),
        ("AlwaysSuccess ok",),
        ("AlwaysSuccess  #2",),
        ("f",),
    ]
