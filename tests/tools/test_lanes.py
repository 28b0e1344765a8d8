"""Failures of two runs of pytest are listed at the end, and a few tests are run again."""

from __future__ import annotations

import sys

import pytest

from tests.tools.lanes import AGAIN_AT_MOST, ERROR_LINES, NOT_COMPLETE, Lane, to_repeat

WALK = "FAILED tests/e2e/test_a.py::test_walk[dark] - AssertionError: no\n"
CASE = "FAILED tests/cli/test_b.py::test_b[a b - c] - AssertionError\n"


@pytest.mark.parametrize(
    ("failures", "again"),
    [
        ([], []),
        ([WALK], ["tests/e2e/test_a.py::test_walk[dark]"]),
        ([WALK, CASE], ["tests/e2e/test_a.py::test_walk[dark]", "tests/cli/test_b.py::test_b[a b - c]"]),
        (["ERROR tests/e2e/test_a.py::test_walk - no browser\n"], []),
        ([WALK] * (AGAIN_AT_MOST + 1), []),
    ],
)
def test_few_tests_that_failed_are_run_again_alone(failures: list[str], again: list[str]) -> None:
    assert to_repeat(failures) == again


def test_each_failure_is_listed_with_the_beginning_of_its_error() -> None:
    lane = Lane("browser", [])
    for line in ("E   not in an error\n", "_____ test_walk[dark] _____\n", "    assert x\n"):
        lane.read(line)
    for number in range(ERROR_LINES + 1):
        lane.read(f"E   line {number}\n")
    lane.read(WALK)
    assert lane.summary == [WALK, *(f"E   line {number}\n" for number in range(ERROR_LINES))]


def test_a_run_that_ends_before_its_summary_is_not_taken_for_failed_tests() -> None:
    lane = Lane("browser", [sys.executable, "-c", "raise SystemExit(1)"])
    lane.run()
    assert lane.result == NOT_COMPLETE
