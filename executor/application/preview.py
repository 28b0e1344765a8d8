"""Converts values of the blackboard to JSON: small plain values unchanged, others to a short text."""

from __future__ import annotations

import math
import reprlib
from typing import Any, Final

__all__ = ["preview", "text_of"]

TEXT_CHARACTERS: Final = 500
ITEMS: Final = 50
ARRAY_ITEMS: Final = 20

_short = reprlib.Repr()
_short.maxlist = _short.maxtuple = _short.maxdict = _short.maxset = _short.maxdeque = 10
_short.maxstring = _short.maxother = 200
_short.maxlevel = 3


def preview(value: Any) -> tuple[Any, bool]:
    """Returns a value that can be written as JSON, and whether it is a preview of the original."""
    if _is_plain(value, depth=3):
        return value, False
    return text_of(value), True


def text_of(value: Any) -> str:
    """Returns a short text that shows a value, whatever it is."""
    try:
        return _describe(value)[:TEXT_CHARACTERS]
    except Exception as error:
        return f"<{type(value).__name__}; its repr raised {type(error).__name__}>"


def _is_plain(value: Any, depth: int) -> bool:
    match value:
        case None | bool():
            return True
        case int():
            return -(2**53) < value < 2**53  # the exact integers of a browser
        case float():
            return math.isfinite(value)
        case str():
            return len(value) <= TEXT_CHARACTERS
        case list() | tuple() | dict() if depth and len(value) <= ITEMS:
            values = value.values() if isinstance(value, dict) else value
            return _has_text_keys(value) and all(_is_plain(item, depth - 1) for item in values)
    return False


def _has_text_keys(value: Any) -> bool:
    return not isinstance(value, dict) or all(isinstance(key, str) for key in value)


def _describe(value: Any) -> str:
    shape, kind = getattr(value, "shape", None), getattr(value, "dtype", None)
    if isinstance(shape, tuple) and kind is not None and math.prod(shape) > ARRAY_ITEMS:
        return f"array {'×'.join(map(str, shape))} of {kind}"
    if hasattr(value, "get_fields_and_field_types") and hasattr(value, "width") and hasattr(value, "height"):
        return f"{type(value).__name__} {value.width}×{value.height}"
    return _short.repr(value)
