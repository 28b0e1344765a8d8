"""Lines that a child prints."""

from __future__ import annotations

import time
from typing import Any

from executor.supervision.output import LineReader, RateLimit


def test_the_rate_limit_lets_a_burst_through_and_counts_the_rest():
    limit = RateLimit(per_s=10, burst=5)
    assert [limit.admits(0.0) for _ in range(7)] == [True] * 5 + [False] * 2
    assert limit.take_held_back() == 2
    assert limit.admits(0.1)
    assert not limit.admits(0.1)


def test_lines_are_cut_and_given_their_level():
    said: list[Any] = []
    reader = LineReader("info", said.append, time.monotonic)
    reader.feed(b"[WARN] [12.5] [node]: low ba")
    reader.feed(b"ttery\nplain\r\n\xff\n" + b"x" * 9000)
    assert [(m.level, m.text) for m in said[:3]] == [
        ("warning", "[WARN] [12.5] [node]: low battery"),
        ("info", "plain"),
        ("info", "\ufffd"),
    ]
    assert len(said[3].text) == 4000
