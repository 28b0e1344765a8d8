"""Script and ScriptCondition."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import letters, load
from tree_gardener import TickError
from tree_gardener.leaves.scripts import Script, ScriptCondition


def test_a_script_writes_and_succeeds() -> None:
    tree = load(f"<{Script.__name__} code='x := 2 * 3'/>")
    assert letters(tree, 1) == "S"
    assert tree.blackboard["x"] == 6
    assert letters(load("<Script code=''/>"), 1) == "S"


@pytest.mark.parametrize(("code", "result"), [("1 &lt; 2", "S"), ("2 &lt; 1", "F"), ("x := 0; x == 0", "S")])
def test_a_condition_is_its_last_value(code: str, result: str) -> None:
    assert letters(load(f"<{ScriptCondition.__name__} code='{code}'/>"), 1) == result


def test_an_error_names_the_script() -> None:
    for kind in ("Script", "ScriptCondition"):
        with pytest.raises(TickError, match="in the script 'a \\+ 1'"):
            load(f"<{kind} code='a + 1'/>").tick_exactly_once()
