"""Pre- and post-conditions of any node."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import letters, load
from tree_gardener.conditions import CONDITIONS, POST_CONDITIONS, PRE_CONDITIONS, compile_conditions
from tree_gardener.errors import ScriptError


@pytest.mark.parametrize(
    ("attribute", "result"), [("_failureIf", "F"), ("_successIf", "S"), ("_skipIf", "K")]
)
def test_a_true_condition_decides_without_a_tick(attribute: str, result: str) -> None:
    assert letters(load(f"<Running {attribute}='true'/>"), 1) == result
    assert letters(load(f"<Running {attribute}='false'/>"), 1) == "R"


def test_while_ends_a_node_that_runs() -> None:
    tree = load("<Running _while='go' _onHalted='halted := 1'/>")
    tree.blackboard["go"] = 1
    assert letters(tree, 1) == "R"
    tree.blackboard["go"] = 0
    assert letters(tree, 1) == "K"
    assert tree.blackboard["halted"] == 1


def test_scripts_run_after_a_result() -> None:
    tree = load("<Succeeding _onSuccess='a := 1' _onFailure='b := 1' _post='c := 1'/>")
    assert letters(tree, 1) == "S"
    assert sorted(tree.blackboard) == ["a", "c"]


def test_only_conditions_are_compiled() -> None:
    assert set(compile_conditions({"name": "x :=", "_post": "x := 1"})) == {"_post"}
    assert set(PRE_CONDITIONS) | set(POST_CONDITIONS) == CONDITIONS
    with pytest.raises(ScriptError):
        compile_conditions({"_post": "x :="})
