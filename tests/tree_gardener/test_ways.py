"""The choice between the nodes' own methods, generated code, and the shortest way to tick."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.trees import load
from tree_gardener import Status, Tree
from tree_gardener.deep import DEEP

if TYPE_CHECKING:
    from tree_gardener.ways import Ways

BODY = "<Sequence><Succeeding/><Fallback><Failing/><Succeeding/></Fallback></Sequence>"


def made() -> tuple[Tree, Ways]:
    """A tree with all its code, and its ways."""
    tree = load(BODY)
    tree.generated_source()
    ways = tree._ways
    assert ways.is_plain
    return tree, ways


def test_the_shortest_way_waits_until_all_code_is_generated() -> None:
    tree = load(BODY)
    assert not tree._ways.is_plain
    tree.tick_exactly_once()
    assert tree._ways.is_plain
    tree.generate_code(on=False)
    assert tree._ways.is_plain, "there is nothing to generate"


def test_observers_and_clocks_take_the_longer_way() -> None:
    tree, ways = made()
    remove = tree.observe(lambda changes: None)
    tree.generated_source()
    assert not ways.is_plain
    remove()
    tree.generated_source()
    assert ways.is_plain
    tree.time_leaves()
    tree.generated_source()
    assert not ways.is_plain
    tree.time_leaves(on=False)
    tree.generated_source()
    assert ways.is_plain


def test_deep_trees_take_the_longer_way() -> None:
    tree = load("<Inverter>" * (DEEP + 1) + "<Succeeding/>" + "</Inverter>" * (DEEP + 1))
    tree.generated_source()
    assert not tree._ways.is_plain


def test_a_hook_of_the_root_is_called_from_the_next_tick_on() -> None:
    tree, ways = made()
    before = ways.tick_root
    seen: list[tuple[int, Status]] = []
    remove = tree.add_hook(after=lambda node, status: seen.append((node.uid, status)), node=1)
    assert ways.tick_root != before
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [(1, Status.SUCCESS)]
    remove()
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert len(seen) == 1


def test_a_hook_of_another_node_leaves_the_root_alone() -> None:
    tree, ways = made()
    before = ways.tick_root
    seen: list[int] = []
    tree.add_hook(before=lambda node: seen.append(node.uid), node=4)
    assert ways.tick_root == before
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [4]


def test_a_hook_of_a_node_that_is_not_there_changes_nothing() -> None:
    tree, _ = made()
    tree.add_hook(before=lambda node: Status.FAILURE, node=99)
    assert tree.tick_exactly_once() is Status.SUCCESS


def test_what_comes_within_one_context_is_linked_once_at_its_end() -> None:
    tree, ways = made()
    seen: list[int] = []
    before = tree.nodes[0].ticks
    with tree.linked_once():
        tree.observe(lambda changes: seen.append(1))
        tree.observe(lambda changes: seen.append(2))
        assert tree.nodes[0].ticks is before
    after = tree.nodes[0].ticks
    assert after is not before
    tree.tick_exactly_once()
    assert seen == [1, 2]
    with tree.linked_once():
        pass
    assert tree.nodes[0].ticks is after, "nothing was due"
    remove = tree.observe(lambda changes: seen.append(3))
    assert tree.nodes[0].ticks is not after
    remove()
    assert not ways.is_plain
