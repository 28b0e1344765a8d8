"""Long and deep scripts: one limit for check, run, conformance and packages, and no error of recursion."""

from __future__ import annotations

import sys

import pytest

from translator import Diagnostic, check, from_xml
from translator.limits import SCRIPT_CHARACTERS
from tree_gardener import LoadError, Status, TickError, Tree
from tree_gardener.blackboard import Blackboard
from tree_gardener.conformance import run_case
from tree_gardener.errors import ScriptError, shown
from tree_gardener.script import Environment, bind_run, bind_test, compile_script, names_read, parse
from tree_gardener.script.parser import MAX_CHARACTERS, MAX_NESTING

DOCUMENT = '<root BTCPP_format="4"><BehaviorTree ID="M"><Script code="{}"/></BehaviorTree></root>'
LEVELS = "1||0&&1==1|0^1&1+0*"
SOUND = {
    "600 terms": ("r:=" + "+".join(["1"] * 600), 600.0),
    "9,000 terms": ("r:=" + "+".join(["1"] * 9_000), 9_000.0),
    "mixed operators": ("r:=" + "+1*1-".join(["1"] * 1_500), 1.0),
    "9,000 texts": ("r:=" + "+".join(["''"] * 6_000), ""),
    "200 brackets": ("r:=" + "1+(" * 200 + "1" + ")" * 200, 201.0),
    "prefixes": ("r:=" + "-" * MAX_NESTING + "1", 1.0),
    "comparisons": ("r:=" + "==".join(["1"] * 4_000), 1.0),
    "choices": ("r:=" + "0?2:" * 200 + "3", 3.0),
    "assignments": ("a:=" * 200 + "7", 7),
    "all levels of operators in each bracket": ("r:=" + (LEVELS + "(") * 240 + "1" + ")" * 240, 1.0),
    "many statements": ("r:=0;" + "r+=1;" * 2_000, 2_000),
}


@pytest.mark.parametrize("name", SOUND)
def test_a_long_script_runs_everywhere(name: str) -> None:
    code, value = SOUND[name]
    board = Blackboard()
    environment = Environment(board, {})
    assert bind_run(code, environment)() == value
    assert compile_script(code).run(environment) == value
    assert names_read(parse(code)) is not None
    tree = Tree.from_xml(DOCUMENT.format(code.replace("&", "&amp;")))
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert tree.blackboard["a" if code.startswith("a") else "r"] == value


def test_a_long_condition_is_tested() -> None:
    assert bind_test("&&".join(["1"] * 2_000), Environment(Blackboard(), {}))() is True


def test_the_limit_of_recursion_is_as_before() -> None:
    before = sys.getrecursionlimit()
    compile_script(SOUND["200 brackets"][0]).run(Environment(Blackboard(), {}))
    assert sys.getrecursionlimit() == before


def finding(code: str) -> Diagnostic:
    """Returns the finding of `check` in a script."""
    (found,) = (item for item in check(from_xml(DOCUMENT.format(code))) if item.is_error)
    return found


LONG = "r:=" + "+".join(["1"] * (MAX_CHARACTERS // 2))
DEEP = "(" * (MAX_NESTING + 1) + "1" + ")" * (MAX_NESTING + 1)


@pytest.mark.parametrize("code", [LONG, DEEP])
def test_one_limit_holds_for_check_run_and_conformance(code: str) -> None:
    with pytest.raises(ScriptError):
        parse(code)
    with pytest.raises(LoadError) as refused:
        Tree.from_xml(DOCUMENT.format(code))
    assert [problem.code for problem in refused.value.diagnostics] == ["TG401"]
    assert len(str(refused.value)) < 300
    case = {"name": "long", "xml": DOCUMENT.format(code), "ticks": 1, "expected": []}
    assert run_case(case).deviation == "long-script"
    found = finding(code)
    assert found.code == "BT0302"
    assert len(found.message) < 300


def test_the_limits_are_those_of_the_table() -> None:
    assert MAX_CHARACTERS == SCRIPT_CHARACTERS


def test_a_message_shows_80_characters_of_a_script() -> None:
    assert shown("x" * 80) == "x" * 80
    assert shown("x" * 81) == "x" * 79 + "…"
    tree = Tree.from_xml(DOCUMENT.format("r:=" + "+".join(["1"] * 500) + "+nix"))
    with pytest.raises(TickError) as raised:
        tree.tick_exactly_once()
    assert "…" in str(raised.value)
    assert len(str(raised.value)) < 200


def test_a_finding_shows_the_place_of_the_error() -> None:
    found = finding("r:=" + "+".join(["1"] * 500) + "+ + 2")
    assert "+ + 2”" in found.message
    assert len(found.message) < 250
