"""Output of actions, line by line."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from executor.application.console import Console
from executor.application.locate import Locator
from executor.supervision.channel import ChannelClosed

if TYPE_CHECKING:
    from executor.child_messages import Log


def test_a_line_is_sent_when_it_is_complete() -> None:
    said: list[Log] = []
    console = Console("info", said.append, Locator(), io.StringIO(), lambda: 1.5)
    print("one\ntw", end="", file=console)
    assert [log.text for log in said] == ["one"]
    print("o", file=console)
    print("three", end="", file=console, flush=True)
    assert [log.text for log in said] == ["one", "two", "three"]
    assert said[0].level == "info"


def test_a_flood_is_cut_and_counted() -> None:
    said: list[Log] = []
    console = Console("info", said.append, Locator(), io.StringIO(), lambda: 0.0)
    for number in range(100_000):
        console.write(f"{number}\n")
    assert 0 < len(said) < 50_000


def test_a_forked_process_prints_to_the_stream_below() -> None:
    def closed(_: Log) -> None:
        raise ChannelClosed

    original = io.StringIO()
    Console("error", closed, Locator(), original, lambda: 0.0).write("last words\n")
    assert original.getvalue() == "last words\n"
