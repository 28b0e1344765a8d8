"""The failures of a lane are listed at the end, with the beginnings of their errors."""

from __future__ import annotations

import sys
from pathlib import Path

from tests.tools.lanes import ERROR_LINES, LAST_LINES, NOT_COMPLETE, PASSED, TESTS_FAILED, Lane

WALK = "FAILED tests/e2e/test_a.py::test_walk[dark] - AssertionError: no\n"
PAGE = "\x1b[31m FAIL \x1b[39m  components  src/a.test.tsx > Palette > finds\n"


def lane(name: str, *command: str) -> Lane:
    return Lane(name, [*command], Path.cwd())


def failed(lines: list[str]) -> list[str]:
    heard = lane("python")
    heard.result = TESTS_FAILED
    for line in lines:
        heard.read(line)
    return heard.summary


def test_each_failure_is_listed_with_the_beginning_of_its_error() -> None:
    error = [f"E   line {number}\n" for number in range(ERROR_LINES + 1)]
    lines = ["E   not in an error\n", "_____ test_walk[dark] _____\n", "    assert x\n", *error, WALK]
    assert failed(lines) == [WALK, *error[:ERROR_LINES]]


def test_a_failure_of_the_page_is_found_below_its_colours() -> None:
    assert failed([PAGE, "other\n"]) == [" FAIL   components  src/a.test.tsx > Palette > finds\n"]


def test_of_a_command_without_named_failures_the_last_lines_are_shown() -> None:
    lines = [f"line {number}\n" for number in range(LAST_LINES + 5)]
    assert failed(lines) == lines[-LAST_LINES:]


def test_a_run_that_ends_before_its_summary_is_not_taken_for_failed_tests() -> None:
    heard = lane("python", sys.executable, "-c", "raise SystemExit(1)", "pytest")
    heard.run()
    assert heard.result == NOT_COMPLETE


def test_a_lane_says_what_it_cost_with_the_children_of_its_command() -> None:
    burn = "import time\nend = time.process_time() + 0.3\nwhile time.process_time() < end: pass"
    child = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {burn!r}], check=True)"
    heard = lane("page", sys.executable, "-c", child)
    heard.run()
    assert heard.result == PASSED
    assert heard.processor_s >= 0.3
    assert heard.summary == []
