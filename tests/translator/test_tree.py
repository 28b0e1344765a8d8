"""A tree as a value: every edit gives another one."""

from __future__ import annotations

from translator.tree import Node, Tree, pointer, reachable_trees, used_types

TREE = Tree(
    "T",
    "r",
    {
        "r": Node("r", "Sequence", children=("a", "b")),
        "a": Node("a", "Inverter", children=("c",)),
        "b": Node("b", "SubTree", tree="U"),
        "c": Node("c", "Drive"),
    },
)


def test_it_is_walked_in_both_orders() -> None:
    assert [node.id for node in TREE.walk()] == ["r", "a", "c", "b"]
    assert [node.id for node in TREE.post_order()] == ["b", "c", "a", "r"]
    assert TREE.depth() == 3
    assert TREE.parents() == {"a": "r", "b": "r", "c": "a"}


def test_nodes_are_moved_and_removed() -> None:
    assert [node.id for node in TREE.moved("c", parent="r", index=0).walk()] == ["r", "c", "a", "b"]
    assert [node.id for node in TREE.removed("a").walk()] == ["r", "b"]


def test_calls_of_trees_are_followed() -> None:
    other = Tree("U", "x", {"x": Node("x", "AlwaysSuccess")})
    alone = Tree("V", "x", {"x": Node("x", "AlwaysSuccess")})
    assert reachable_trees({"T": TREE, "U": other, "V": alone}, "T") == ["T", "U"]
    assert [node.tree for node in TREE.subtree_calls()] == ["U"]
    assert used_types([TREE, other]) >= {"Drive", "AlwaysSuccess"}


def test_a_pointer_is_a_key_in_braces() -> None:
    assert [pointer(text, "speed") for text in ("{x}", " {x} ", "{=}", "x", "{x")] == [
        *("x", "x", "speed", None, None)
    ]
