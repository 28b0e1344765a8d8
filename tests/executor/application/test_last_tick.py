"""Statuses of the last tick, and the node that decided how the tree ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.application.last_tick import LastTick
from tests.tree_gardener.trees import load
from tree_gardener import Status

if TYPE_CHECKING:
    from tree_gardener import Tree


def watched(xml: str) -> tuple[Tree, LastTick]:
    tree, last = load(xml), LastTick()
    tree.observe(last.take)  # type: ignore[arg-type] # observers return nothing
    return tree, last


def past(tree: Tree, last: LastTick) -> dict[str, str]:
    return {tree.nodes[uid - 1].name: status.name for uid, status in sorted(last.past.items())}


def test_results_that_were_reset_within_the_tick_stay() -> None:
    tree, last = watched("<Sequence><Succeeding name='a'/><Failing name='b'/></Sequence>")
    tree.tick_exactly_once()
    assert past(tree, last) == {"Sequence": "FAILURE", "a": "SUCCESS", "b": "FAILURE"}


def test_they_stay_over_the_halt_after_the_tick_and_go_with_the_next_one() -> None:
    tree, last = watched("<Sequence><Succeeding name='a'/><Running name='b'/></Sequence>")
    tree.tick_exactly_once()
    assert past(tree, last) == {}
    tree.halt()
    assert past(tree, last) == {"Sequence": "RUNNING", "a": "SUCCESS", "b": "RUNNING"}
    tree.halt()
    assert past(tree, last) == {"Sequence": "RUNNING", "a": "SUCCESS", "b": "RUNNING"}
    tree.tick_exactly_once()
    assert past(tree, last) == {}


def test_a_result_hides_the_status_from_before_the_tick() -> None:
    tree, last = watched("<Sequence><Sleep name='a' msec='0'/><Failing name='b'/></Sequence>")
    while tree.tick_exactly_once() is Status.RUNNING:
        assert past(tree, last) == {}
    assert past(tree, last) == {"Sequence": "FAILURE", "a": "SUCCESS", "b": "FAILURE"}


def decider(xml: str) -> str:
    tree, last = watched(xml)
    return last.decider(tree.nodes, tree.tick_exactly_once()).name


def test_the_lowest_node_with_the_roots_status_decided() -> None:
    assert decider("<Sequence><Succeeding name='a'/><Failing name='b'/></Sequence>") == "b"
    assert decider("<Fallback><Failing name='a'/><Failing name='b'/></Fallback>") == "b"
    assert decider("<Sequence><Fallback name='f'><Failing name='a'/></Fallback></Sequence>") == "a"
    assert decider("<Sequence><Succeeding name='a'/><Succeeding name='b'/></Sequence>") == "b"


def test_a_node_that_turned_the_result_round_decided() -> None:
    assert decider("<Sequence><Inverter name='i'><Succeeding name='a'/></Inverter></Sequence>") == "i"
    assert decider("<Sequence name='s' _failureIf='true'><Succeeding name='a'/></Sequence>") == "s"
