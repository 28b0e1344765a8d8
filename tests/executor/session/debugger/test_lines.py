"""A breakpoint in Python as debugpy gets it: one condition of all that it has."""

from __future__ import annotations

from typing import Any

import pytest

from executor.application.python import stops as python_stops
from executor.session.debugger.lines import LONGEST, with_one_condition


def given(**has: Any) -> Any:
    [found] = with_one_condition([{"line": 7, **has}], 3, "actions/It's.py")
    return found


@pytest.mark.parametrize(
    "has",
    [
        {},
        {"hitCondition": ">=3"},
        {"condition": ""},
        {"condition": "x", "hitCondition": "% 3"},
        {"condition": 5},
        {"condition": "x" * (LONGEST + 1)},
    ],
)
def test_what_debugpy_decides_alone_is_left_to_it(has: dict[str, Any]) -> None:
    assert given(**has) == {"line": 7, **has}


@pytest.mark.parametrize("breakpoints", [None, "x", [None, 3, {"line": "7", "condition": "x"}]])
def test_what_are_no_breakpoints_is_left_to_it(breakpoints: Any) -> None:
    assert with_one_condition(breakpoints, 1, "actions/A.py") == breakpoints


def test_all_else_is_one_condition_that_the_program_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    monkeypatch.setattr(python_stops, "stops", lambda *values: asked.append(values) or True)
    found = given(condition="a == '\"'", hitCondition=" >= 3 ", logMessage="n {n}\n")
    assert found.keys() == {"line", "condition"}
    assert eval(found["condition"], {"g": 1}, {"n": 2})  # noqa: S307 - as debugpy does
    place, condition, hits, log, (of_all, own) = asked[0]
    assert (place, condition, hits, log) == ((3, "actions/It's.py", 7), "a == '\"'", 3, "n {n}\n")
    assert (of_all["g"], own["n"]) == (1, 2)
