"""Reads the words of a `break` command."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, Final

from tree_gardener import Status
from tree_gardener.debugging import Breakpoint, When

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener.debugging import Place

MOMENTS: Final[dict[str, tuple[When, Status | None]]] = {
    "before": (When.BEFORE, None),
    "after": (When.AFTER, None),
    "halted": (When.HALTED, None),
    "success": (When.RETURNS, Status.SUCCESS),
    "failure": (When.RETURNS, Status.FAILURE),
    "running": (When.RETURNS, Status.RUNNING),
    "skipped": (When.RETURNS, Status.SKIPPED),
}
RESULTS: Final = {name: status for name, (_, status) in MOMENTS.items() if status is not None}


class WordsError(ValueError):
    """A command cannot be read; the text says why."""


def split(line: str) -> list[str]:
    """Splits a line into words; quotes hold words together.

    Raises:
        WordsError: a quote is not closed.
    """
    try:
        return shlex.split(line)
    except ValueError as error:
        raise WordsError(f"{error}: {line}") from None


def whole(text: str) -> int | None:
    """Returns a number of at most nine digits; None for any other text."""
    return int(text) if text.isdecimal() and len(text) < 10 else None


def breakpoint_of(line: str, place_named: Callable[[str], Place]) -> Breakpoint:
    """Returns the breakpoint of ``NODE [MOMENT] [if CONDITION] [hits N] [log TEXT]``.

    Raises:
        WordsError: the line does not have this form.
    """
    words = split(line)
    if not words:
        raise WordsError(
            "name a node: break NODE [before|after|success|…] [if 'CONDITION'] [hits N] [log 'TEXT']"
        )
    place = place_named(words.pop(0))
    when, status = MOMENTS["before"]
    if words and words[0] in MOMENTS:
        when, status = MOMENTS[words.pop(0)]
    options = {"if": "", "hits": "1", "log": ""}
    while words:
        name = words.pop(0)
        if name not in options:
            raise WordsError(
                f"'{name}' is not one of {', '.join((*MOMENTS, *options))}; put texts into quotes"
            )
        if not words:
            raise WordsError(f"nothing stands behind '{name}'")
        options[name] = words.pop(0)
    hits = whole(options["hits"])
    if hits is None:
        raise WordsError(f"the hit count '{options['hits'][:20]}' is no number, or too large")
    return Breakpoint(place, when, status, options["if"], hits, options["log"])
