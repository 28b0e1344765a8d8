"""Makes one condition of what a breakpoint in Python has, which the program itself decides. Pure."""

from __future__ import annotations

import re
from typing import Any, Final

__all__ = ["with_one_condition"]

LONGEST: Final = 1000
"""The most characters of a condition or log line."""
_FROM: Final = re.compile(r"\s*>=\s*(\d{1,9})\s*")
_ASKS: Final = (
    "__import__('executor.application.python.stops', fromlist=['stops'])"
    ".stops({place!r}, {condition!r}, {hits!r}, {log!r}, (globals(), locals()))"
)


def with_one_condition(breakpoints: Any, number: int, path: str) -> Any:
    """Returns the breakpoints of a request `setBreakpoints` as debugpy gets them.

    Only plain ones, and those that count in another way than `>=N`, are left to debugpy.

    Args:
        breakpoints: as the client sent them, so perhaps no breakpoints at all.
        number: differs from setting to setting, so that counts begin again.
        path: the file as the project names it.
    """
    if not isinstance(breakpoints, list):
        return breakpoints
    return [_joined(each, number, path) for each in breakpoints]


def _joined(one: Any, number: int, path: str) -> Any:
    if not isinstance(one, dict) or type(one.get("line")) is not int:
        return one
    condition, log = (one.get(name) or "" for name in ("condition", "logMessage"))
    counted = one.get("hitCondition") or ""
    if not all(isinstance(text, str) and len(text) <= LONGEST for text in (condition, log, counted)):
        return one
    found = _FROM.fullmatch(counted) if counted else None
    if not (condition or log) or (counted and found is None):
        return one
    hits = int(found[1]) if found else 1
    asks = _ASKS.format(place=(number, path, one["line"]), condition=condition, hits=hits, log=log)
    return {"line": one["line"], "condition": asks}
