"""Hooks before and after the ticks of nodes."""

from __future__ import annotations

import collections
from typing import TYPE_CHECKING, Final

import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import generate
from tests.tree_gardener.test_observe import tree_of
from tests.tree_gardener.trees import leaf, load, recording
from tree_gardener import Status, TickError
from tree_gardener.hooks import Hook, Hooks

if TYPE_CHECKING:
    from tree_gardener.node import Node

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE
RESULTS: Final = (Status.SUCCESS, Status.FAILURE, Status.RUNNING, Status.SKIPPED)
SEEDS: Final = 100


def test_a_hook_before_a_node_takes_its_place() -> None:
    tree = load('<Sequence><A name="a"/><Succeeding/></Sequence>', nodes={"A": recording(S)})
    remove = tree.add_hook(before=lambda node: Status.FAILURE, node=2)
    assert tree.tick_exactly_once() is Status.FAILURE
    assert leaf(tree, "a").calls == []
    remove()
    remove()
    assert tree.tick_exactly_once() is Status.SUCCESS


def test_a_hook_after_a_node_replaces_its_result() -> None:
    tree = load("<Inverter><Sequence><Succeeding/></Sequence></Inverter>")
    seen: list[tuple[str, Status]] = []

    def after(node: Node, status: Status) -> Status | None:
        seen.append((node.type, status))
        return Status.FAILURE if node.type == "Sequence" else None

    tree.add_hook(after=after)
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [
        ("Succeeding", Status.SUCCESS),
        ("Sequence", Status.SUCCESS),
        ("Inverter", Status.SUCCESS),
    ]


@pytest.mark.parametrize("status", [Status.SUCCESS, Status.FAILURE, Status.SKIPPED, Status.RUNNING])
def test_a_hook_can_give_a_running_node_any_result(status: Status) -> None:
    tree = load("<Sequence><Running/></Sequence>")
    tree.tick_exactly_once()
    tree.add_hook(before=lambda node: status, node=tree.nodes[0])
    assert tree.tick_exactly_once() is status


def test_a_hook_must_not_return_idle() -> None:
    tree = load("<Succeeding/>")
    tree.add_hook(before=lambda node: Status.IDLE)
    with pytest.raises(ValueError, match="IDLE"):
        tree.tick_exactly_once()


def test_hooks_do_not_disturb_what_nodes_remember() -> None:
    tree = load(
        "<Sequence><Succeeding/><RunOnce><A name='a'/></RunOnce></Sequence>", nodes={"A": recording(R, S)}
    )
    tree.tick_exactly_once()
    tree.add_hook(before=lambda node: None)()
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    assert leaf(tree, "a").calls.count("update") == 2


def test_a_hook_of_one_node_applies_to_that_alone() -> None:
    tree = load("<Sequence><Succeeding/><Succeeding/></Sequence>")
    hooks = Hooks(tree)
    hooks.hooks.append(Hook(2, None, None))
    entries = [hooks.entry(node, node.execute) for node in tree.nodes]
    plain = [node.execute for node in tree.nodes]
    assert [entry != own for entry, own in zip(entries, plain, strict=True)] == [False, True, False]


def test_results_are_counted_as_hooks_see_them() -> None:
    for seed in range(1, 1 + SEEDS):
        case = generate(seed)
        counted, hooked = tree_of(case), tree_of(case)
        counts = counted.count_results()
        assert counted.count_results() is counts
        seen = collections.Counter[tuple[int, Status]]()

        def note(node: Node, status: Status, seen: collections.Counter[tuple[int, Status]] = seen) -> None:
            seen[node.uid, status] += 1

        hooked.add_hook(after=note)
        for _ in range(case.ticks):
            try:
                counted.tick_exactly_once()
            except TickError:
                with pytest.raises(TickError):
                    hooked.tick_exactly_once()
                break
            hooked.tick_exactly_once()
        for node, count in zip(counted.nodes, counts, strict=True):
            one = {status: seen[node.uid, status] for status in RESULTS}
            found = (count.success, count.failure, count.running, count.skipped)
            assert found == tuple(one.values()), f"seed {seed}, node {node.uid}"
            assert count.ticks == sum(one.values())


def test_a_count_includes_what_hooks_decided() -> None:
    tree = load("<Sequence><Succeeding/></Sequence>")
    counts = tree.count_results()
    remove = tree.add_hook(before=lambda node: Status.FAILURE, node=2)
    tree.tick_exactly_once()
    remove()
    tree.tick_exactly_once()
    assert [(count.success, count.failure) for count in counts] == [(1, 1), (1, 1)]


def test_leaves_are_marked_in_memory_that_may_be_replaced() -> None:
    seen: list[tuple[int, int]] = []

    class Asking(Behaviour):
        def update(self) -> PyTreesStatus:
            seen.append((tree.current_uid, memory[0]))
            return PyTreesStatus.RUNNING

    memory = [0]
    tree = load("<Sequence><Succeeding/><Asking/></Sequence>", nodes={"Asking": Asking})
    tree.tick_exactly_once()
    tree.mark_leaves()
    tree.tick_exactly_once()
    tree.current = memory
    tree.tick_exactly_once()
    tree.add_hook(after=lambda node, status: None)
    tree.tick_exactly_once()
    tree.mark_leaves(on=False)
    tree.tick_exactly_once()
    assert seen == [(0, 0), (3, 0), (3, 3), (3, 3), (0, 0)]
    assert (tree.current_uid, tree.slowest) == (0, (0.0, 0))
