"""Ticks that leave the usual way continue in the nodes' own methods."""

from __future__ import annotations

from typing import Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import Raising, leaf, load, recording
from tree_gardener import Status, TickError, Tree
from tree_gardener.generated import generation
from tree_gardener.generated.recovery import UNTICKED, Recovery

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


def states(tree: Tree) -> str:
    return "".join(node.status.letter for node in tree.nodes)


def has_code(tree: Tree) -> bool:
    return getattr(tree.nodes[0], "quick", None) is not None


def test_a_running_leaf_makes_all_nodes_above_running() -> None:
    tree = load(
        "<Sequence><Inverter><Failing/></Inverter><Fallback><Failing/><Inverter><Running/></Inverter>"
        "</Fallback><Succeeding/></Sequence>"
    )
    assert tree.tick_exactly_once() is Status.RUNNING
    assert has_code(tree)
    assert states(tree) == "RSIRFRRI"
    assert tree.nodes[0].index == 1  # type: ignore[attr-defined]


def test_a_skipped_leaf_counts_in_its_parent() -> None:
    tree = load(
        "<Sequence><A/><Sequence><A/><A/></Sequence><B/></Sequence>",
        nodes={"A": recording(Status.SKIPPED), "B": recording(S)},
    )
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert states(tree) == "IIIIII"


def test_an_exception_is_located_and_leaves_the_statuses_of_the_tick() -> None:
    tree = load("<Sequence><Succeeding/><Fallback><Failing/><Raising name='bad'/></Fallback></Sequence>")
    with pytest.raises(TickError) as caught:
        tree.tick_exactly_once()
    assert has_code(tree)
    assert (caught.value.path, caught.value.node_type) == ("bad", "Raising")
    assert caught.value.file.endswith("trees.py")
    code = Raising.update.__code__
    assert code.co_firstlineno < caught.value.line <= code.co_firstlineno + 2
    assert "<tick>" not in caught.value.traceback_text
    assert "tree_gardener/generated" not in caught.value.traceback_text
    assert states(tree) == "RSRFI"


def test_the_trace_of_an_error_that_passes_through_has_no_line_twice() -> None:
    tree = load(
        "<Sequence><Sequence><Repeat num_cycles='1'><Raising/></Repeat><Succeeding/></Sequence></Sequence>"
    )
    with pytest.raises(TickError) as caught:
        tree.tick_exactly_once()
    assert has_code(tree)
    ticks = [entry for entry in caught.traceback if str(entry.path).endswith("<tick>")]
    assert len(ticks) <= 2


def test_a_failure_that_is_counted_does_not_end_the_tick() -> None:
    tree = load("<Fallback><Succeeding _failureIf='true'/><Raising/><Succeeding/></Fallback>")
    errors: list[TickError] = []
    tree.on_error = errors.append
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert [error.uid for error in errors] == [3]
    assert tree.nodes[2].behaviour.status is F


def test_a_parallel_continues_after_an_exception() -> None:
    class Late(py_trees.behaviour.Behaviour):
        ticks = 0

        def update(self) -> PyTreesStatus:
            self.ticks += 1
            if self.ticks == 2:
                raise ValueError
            return R

    tree = load(
        "<ParallelAll max_failures='2'><A name='a'/><Late/><A name='b'/></ParallelAll>",
        nodes={"A": recording(R), "Late": Late},
    )
    tree.on_error = lambda error: None
    assert tree.tick_exactly_once() is Status.RUNNING
    assert tree.tick_exactly_once() is Status.RUNNING
    assert has_code(tree)
    assert states(tree) == "RRFR"
    assert leaf(tree, "b").calls.count("update") == 2


@pytest.mark.parametrize(
    ("attributes", "result", "calls"),
    [
        ('_skipIf="true"', Status.SKIPPED, 0),
        ('_failureIf="true" _onFailure="seen := 1"', Status.FAILURE, 0),
        ('_successIf="true" _post="seen := 1"', Status.SUCCESS, 0),
        ('_while="false"', Status.SKIPPED, 0),
        ('_while="true" _onSuccess="seen := 1"', Status.SUCCESS, 1),
    ],
)
def test_a_condition_decides(attributes: str, result: Status, calls: int) -> None:
    tree = load(f"<Sequence><A name='a' {attributes}/></Sequence>", nodes={"A": recording(S)})
    assert tree.tick_exactly_once() is result
    assert has_code(tree)
    assert leaf(tree, "a").calls.count("update") == calls
    assert ("seen" in tree.blackboard) == ("seen" in attributes)


@pytest.mark.parametrize(
    ("body", "states_after"),
    [
        ("<Sequence><A/><A _skipIf='nowhere'/></Sequence>", "RSI"),
        ("<Sequence><A/><A _onSuccess='nowhere + 1'/></Sequence>", "RSI"),
        ("<Sequence><A/><Sequence _post='nowhere + 1'><A/></Sequence></Sequence>", "RSRI"),
        ("<Sequence><A/><ScriptCondition code='nowhere'/></Sequence>", "RSI"),
        ("<Sequence><A/><Script code='x := nowhere'/></Sequence>", "RSI"),
    ],
)
def test_an_error_in_a_script_names_it(body: str, states_after: str) -> None:
    messages = []
    for on in (True, False):
        tree = load(body, nodes={"A": recording(S)})
        tree.generate_code(on=on)
        with pytest.raises(TickError, match=r"in the script .*nowhere") as caught:
            tree.tick_exactly_once()
        assert has_code(tree) is on
        assert states(tree) == states_after
        messages.append(str(caught.value))
    assert messages[0] == messages[1]


def test_a_recovery_is_made_for_each_region() -> None:
    made: list[Recovery] = []
    tree = load("<ReactiveSequence><A/></ReactiveSequence>", nodes={"A": recording(R, S)})
    tree.tick_exactly_once()
    function: Any = tree.nodes[0].quick  # type: ignore[attr-defined]
    made = [each.__self__ for each in function.__defaults__ if hasattr(each, "__self__")]
    recovery = next(each for each in made if isinstance(each, Recovery))
    assert recovery.node is tree.nodes[0]
    assert UNTICKED in function.__defaults__
    assert generation.WARM_TICKS == 0
    assert tree.tick_exactly_once() is Status.SUCCESS


@pytest.mark.parametrize("on", [True, False])
@pytest.mark.parametrize("result", [None, "raises"])
@pytest.mark.parametrize("mark", ["mark_leaves", "time_leaves"])
def test_no_action_is_marked_after_a_tick_that_raised(on: bool, result: Any, mark: str) -> None:
    tree = load(
        "<Sequence><Succeeding/><A name='a'/></Sequence>",
        nodes={"A": Raising if result == "raises" else recording(result)},
    )
    tree.generate_code(on=on)
    getattr(tree, mark)()
    with pytest.raises(TickError):
        tree.tick_exactly_once()
    assert has_code(tree) is on
    assert tree.current_uid == 0
