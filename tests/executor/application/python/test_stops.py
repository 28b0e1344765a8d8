"""Whether a program stops at a breakpoint with a condition, a count or a log line."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from executor.application.python import looks
from executor.application.python import stops as python_stops
from executor.application.python.stops import stops, tell_by

_settings = itertools.count(1)


@pytest.fixture
def said() -> Any:
    """Returns the log lines, and what could not be evaluated."""
    lines: list[str] = []
    wrong: list[tuple[str, int, str]] = []
    tell_by(lines.append, lambda *told: wrong.append(told))
    yield lines, wrong
    python_stops._tellers.clear()
    python_stops._lines.clear()


def passes(condition: str = "", hits: int = 1, log: str = "", *, until: int = 60, **names: Any) -> list[int]:
    """Returns the passes at which the program stops; `n` is the number of the pass."""
    place = (next(_settings), "actions/Act.py", 7)
    return [
        n for n in range(1, until) if stops(place, condition, hits, log, ({"base": 1, **names}, {"n": n}))
    ]


def test_the_passes_count_where_the_condition_is_true(said: Any) -> None:
    assert passes("n % 10 == 0") == [10, 20, 30, 40, 50]
    assert passes("n % 10 == 0", 3) == [30, 40, 50]
    assert passes("n > base", 2, until=6) == [3, 4, 5]
    assert passes("", 3, "n = {n}", until=6) == []
    assert said == (["n = 3", "n = 4", "n = 5"], [])


def test_counts_begin_again_when_breakpoints_are_set_again(said: Any) -> None:
    for number in (1, 2):
        place = (number, "actions/Act.py", 7)
        assert [stops(place, "", 2, "", ({}, {})) for _ in range(3)] == [False, True, True]
    stops((2, "actions/Other.py", 1), "", 1, "", ({}, {}))
    assert {each[:2] for each in python_stops._lines} == {(2, "actions/Act.py"), (2, "actions/Other.py")}


@pytest.mark.parametrize(
    ("condition", "error"),
    [
        ("speed > 1", "NameError: name 'speed' is not defined"),
        ("n >", "SyntaxError"),
        ("1 / 0", "ZeroDivisionError"),
        ("broken", "RuntimeError"),
    ],
)
def test_a_condition_that_cannot_be_evaluated_never_stops_and_is_reported_once(
    said: Any, condition: str, error: str
) -> None:
    class Broken:
        def __bool__(self) -> bool:
            raise RuntimeError("no")

    assert passes(condition, broken=Broken()) == []
    [(path, line, text)] = said[1]
    assert (path, line) == ("actions/Act.py", 7)
    assert f"“{condition}” cannot be evaluated: {error}" in text


def test_a_condition_that_never_ends_is_ended(said: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(looks, "LOOK_S", 0.1)
    monkeypatch.setattr(python_stops, "look", lambda: looks.look(0.1))

    def endless() -> None:
        while True:
            pass

    assert passes("endless()", until=2, endless=endless) == []
    assert "it does not end" in said[1][0][2]


@pytest.mark.parametrize(
    ("log", "line"),
    [
        ("no values", "no values"),
        ("n = {n}, {missing} and {base!r}", "n = 1, {missing} and 1"),
        ("{n:03}|{n + 1}|{n != 2}|{{n}}", "001|2|True|{n}"),
        ('{d[\'a\']} "{d["a"]}"', '1 "1"'),
        ("it's {n}", "it's 1"),
        ("{n", "{n"),
        ("{}", "{}"),
        (r"C:\new {n}", r"C:\new 1"),
    ],
)
def test_a_log_line_keeps_the_values_that_it_has(said: Any, log: str, line: str) -> None:
    assert passes("", 1, log, until=2, d={"a": 1}) == []
    assert said[0] == [line]
    assert len(said[1]) == (1 if "missing" in log or (line == log and "{" in log) else 0)


def test_a_long_log_line_is_cut(said: Any) -> None:
    passes("", 1, "{'x' * 10_000}", until=2)
    assert len(said[0][0]) == python_stops.MOST_TEXT
