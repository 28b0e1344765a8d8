"""Hooks before and after the ticks of nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import leaf, load, recording
from tree_gardener import Status
from tree_gardener.hooks import Hook, Hooks

if TYPE_CHECKING:
    from tree_gardener.node import Node

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


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
    assert [hooks.applies(node) for node in tree.nodes] == [False, True, False]
