"""Lines that actions print in lock-step are printed and recorded."""

from __future__ import annotations

import io
import sys
from typing import TYPE_CHECKING

from executor.application.locate import Locator
from executor.headless.output import RecordedOutput, recorded

if TYPE_CHECKING:
    from executor.child_messages import Log


def test_a_line_is_printed_at_once_and_sent_when_it_is_complete() -> None:
    said: list[Log] = []
    below = io.StringIO()
    output = RecordedOutput("info", said.append, Locator(), below, lambda: 1.5)
    errors = RecordedOutput("error", said.append, Locator(), below, lambda: 1.5)
    before = sys.stdout
    with recorded(output, errors):
        print("one\ntw", end="", flush=True)  # noqa: T201 - what is tested
        assert below.getvalue() == "one\ntw"
        print("o")  # noqa: T201 - what is tested
        print("three", file=sys.stderr)  # noqa: T201 - what is tested
    assert sys.stdout is before
    assert [(log.level, log.text, log.time) for log in said] == [
        ("info", "one", 1.5),
        ("info", "two", 1.5),
        ("error", "three", 1.5),
    ]


def test_a_flood_is_cut_by_simulated_time() -> None:
    counts = []
    for _ in range(2):
        said: list[Log] = []
        now = [0.0]
        output = RecordedOutput("info", said.append, Locator(), io.StringIO(), lambda now=now: now[0])
        for number in range(20_000):
            now[0] += 0.001
            output.write(f"{number}\n")
        counts.append(len(said))
    assert counts[0] == counts[1] < 20_000


def test_without_a_recording_nothing_is_replaced() -> None:
    before = sys.stdout
    with recorded(None, None):
        assert sys.stdout is before
