"""The time of each node is measured while a caller wants it, and only then."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.generated.both_ways import RARE, Run, cases
from tests.tree_gardener.trees import load, subtree
from tree_gardener import Status, TickError
from tree_gardener.profiling import NodeTime, Profile, Sums

if TYPE_CHECKING:
    from tests.tree_gardener.fuzz.generate import Case
    from tree_gardener import Tree
    from tree_gardener.node import Node

CASES = 40


class Slow:
    """A tree whose nodes take `uid` s each before they begin, by a clock that nothing else moves."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.now_s = 0.0
        tree.add_hook(before=self.passes)
        self.profile = Profile(tree, lambda: self.now_s)
        tree.profile(self.profile)

    def passes(self, node: Node) -> None:
        self.now_s += node.uid


def test_a_node_has_its_own_time_and_that_of_the_nodes_below() -> None:
    slow = Slow(load("<Sequence><Succeeding/><Inverter><Failing/></Inverter></Sequence>"))
    slow.tree.tick_exactly_once()
    slow.tree.tick_exactly_once()
    assert slow.profile.take() == [
        NodeTime(1, 2, 20.0, 2.0),
        NodeTime(2, 2, 4.0, 4.0),
        NodeTime(3, 2, 14.0, 6.0),
        NodeTime(4, 2, 8.0, 8.0),
    ]


def test_taken_times_are_not_taken_again_and_nodes_without_a_tick_are_left_out() -> None:
    slow = Slow(load("<Fallback><Failing/><Running/><Succeeding/></Fallback>"))
    slow.tree.tick_exactly_once()
    assert [each.uid for each in slow.profile.take()] == [1, 2, 3]
    assert slow.profile.take() == []
    slow.tree.tick_exactly_once()
    assert slow.profile.take() == [NodeTime(1, 1, 4.0, 1.0), NodeTime(3, 1, 3.0, 3.0)]


def test_a_subtree_whose_tree_is_woken_up_and_ticked_again() -> None:
    body = '<Repeat num_cycles="2"><SubTree ID="Sub"/></Repeat>'
    slow = Slow(load(body, subtree("Sub", "<Sequence><Succeeding/></Sequence>")))
    slow.tree.tick_once()
    taken = slow.profile.take()
    assert [each.calls for each in taken] == [2, 2, 2, 2]
    assert [each.self_s for each in taken] == [2.0, 4.0, 6.0, 8.0]
    assert taken[0].total_s == 20.0


def test_a_node_that_raises_is_measured_and_later_ticks_are_right() -> None:
    slow = Slow(load("<Sequence><Succeeding/><Raising/></Sequence>"))
    for _ in range(2):
        with pytest.raises(TickError):
            slow.tree.tick_exactly_once()
    assert [(each.uid, each.self_s) for each in slow.profile.take()] == [(1, 2.0), (2, 4.0), (3, 6.0)]


def test_a_time_can_be_left_out_at_a_node_and_above_it() -> None:
    slow = Slow(load("<Sequence><Succeeding/><Running/></Sequence>"))

    def held(node: Node) -> None:
        slow.now_s += 1000.0
        slow.profile.leave_out(1000.0)

    slow.tree.add_hook(before=held, node=3)
    slow.tree.tick_exactly_once()
    assert [(each.total_s, each.self_s) for each in slow.profile.take()] == [(6, 1), (2, 2), (3, 3)]


def test_nothing_is_left_of_it_in_the_ticks_once_it_is_detached() -> None:
    tree = load("<Sequence><Succeeding/><Running/></Sequence>")
    before = tree.generated_source()
    ticks = [child.entry() for child in tree.nodes[0].children]
    profile = Profile(tree)
    tree.profile(profile)
    assert not tree.generated_source()
    tree.tick_once()
    tree.profile(None)
    assert tree.generated_source() == before != ""
    assert [child.entry() for child in tree.nodes[0].children] == ticks
    profile.take()
    tree.tick_once()
    assert profile.take() == []


def test_a_deep_tree_can_be_measured() -> None:
    depth = 250
    tree = load('<Inverter _skipIf="false">' * depth + "<Running/>" + "</Inverter>" * depth)
    profile = Profile(tree)
    tree.profile(profile)
    assert tree.tick_once() is Status.RUNNING
    assert [each.calls for each in profile.take()] == [1] * (depth + 1)


def test_random_trees_do_the_same_and_their_times_add_up() -> None:
    for case in cases(1, CASES):
        _compare(case)


def _compare(case: Case) -> None:
    plain = Run(case, is_generated=True, letters=RARE, changes=False)
    measured = Run(case, is_generated=True, letters=RARE, changes=False)
    now_s = itertools.count(0.0, 1.0)
    profile = Profile(measured.tree, lambda: next(now_s))
    measured.tree.profile(profile)
    assert measured.run() == plain.run(), case.seed
    taken = {each.uid: each for each in profile.take()}
    assert all(0 < each.self_s <= each.total_s for each in taken.values())
    for uid, each in taken.items():
        below = [taken[c.uid].total_s for c in measured.tree.nodes[uid - 1].children if c.uid in taken]
        assert each.total_s == each.self_s + sum(below), case.seed


def test_sums_add_up_node_by_node() -> None:
    sums = Sums()
    sums.add([NodeTime(3, 1, 0.5, 0.5), NodeTime(1, 1, 1.0, 0.5)])
    sums.add([NodeTime(1, 2, 2.0, 2.0)])
    assert sums.nodes == [NodeTime(1, 3, 3.0, 2.5), NodeTime(3, 1, 0.5, 0.5)]
