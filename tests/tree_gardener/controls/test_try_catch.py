"""TryCatch."""

from __future__ import annotations

from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener import ControlNode
from tree_gardener import Status as EngineStatus
from tree_gardener.controls.try_catch import TryCatch

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE
NAME = TryCatch.__name__


def test_the_last_child_runs_after_a_failure_and_it_fails() -> None:
    tree = load(f"<{NAME}><Failing/><A name='a'/></{NAME}>", nodes={"A": recording(R, S)})
    assert letters(tree, 2) == "RF"
    assert leaf(tree, "a").calls.count("update") == 2


def test_without_a_failure_the_last_child_does_not_run() -> None:
    tree = load(f"<{NAME}><Succeeding/><A name='a'/></{NAME}>", nodes={"A": recording(S)})
    assert letters(tree, 1) == "S"
    assert leaf(tree, "a").calls == []


def test_skips_count_on_after_a_failure_for_a_parent_that_does_not_reset_it() -> None:
    class Own(ControlNode):
        def update(self) -> EngineStatus:
            return self.tick_child(0)

    skipped = recording(EngineStatus.SKIPPED)
    body = f"<Own><{NAME}><K/><A/><Succeeding/></{NAME}></Own>"
    tree = load(body, nodes={"Own": Own, "K": skipped, "A": recording(F, EngineStatus.SKIPPED)})
    # BehaviorTree.CPP 4.10: three skips of two children are not "all were skipped".
    assert letters(tree, 3) == "FSK"


def test_it_may_run_when_the_node_is_halted() -> None:
    xml = f"<{NAME} catch_on_halt='true'><Running/><A name='a'/></{NAME}>"
    tree = load(xml, nodes={"A": recording(S)})
    assert letters(tree, 1) == "R"
    tree.halt()
    assert "update" in leaf(tree, "a").calls
