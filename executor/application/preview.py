"""Converts values of the blackboard to JSON: small plain values unchanged, others to a short text."""

from __future__ import annotations

import math
from itertools import islice
from typing import Any, Final

from tree_gardener.descriptions import readable, text_of

__all__ = ["preview", "text_of"]

TEXT_CHARACTERS: Final = 500
ITEMS: Final = 50
_DEPTH: Final = 3
_EXACT: Final = 2**53
"""The integers of a browser are exact up to this one."""


class _OtherError(Exception):
    """A value is not small and plain."""


def preview(value: Any) -> tuple[Any, bool]:
    """Returns a value that can be written as JSON, and whether it is a preview of the original.

    A number or a text of a derived class, as numpy's, is returned as the plain one that it is.
    """
    try:
        return _plain(value, _DEPTH), False
    except _OtherError:
        return text_of(value, TEXT_CHARACTERS), True


def _plain(value: Any, depth: int) -> Any:
    kind = type(value)
    if value is None or kind is bool:
        return value
    if kind.__module__ == "numpy" and hasattr(kind, "itemsize") and hasattr(kind, "item") and not value.shape:
        return _scalar(value.item())
    if issubclass(kind, (int, float, str)):
        return _scalar(value)
    if not depth:
        raise _OtherError
    if issubclass(kind, dict) and dict.__len__(value) <= ITEMS:
        pairs = list(dict.items(value))
        return {_key(key): _plain(item, depth - 1) for key, item in pairs}
    if issubclass(kind, list) and list.__len__(value) <= ITEMS:
        return [_plain(item, depth - 1) for item in islice(list.__iter__(value), ITEMS)]
    if issubclass(kind, tuple) and tuple.__len__(value) <= ITEMS:
        return tuple(_plain(item, depth - 1) for item in tuple.__iter__(value))
    raise _OtherError


def _scalar(value: Any) -> Any:
    """Returns a number or a text as one of Python's own class, without a method of the user."""
    kind = type(value)
    if value is None or kind is bool:
        return value
    if issubclass(kind, int) and -_EXACT < (number := int.__int__(value)) < _EXACT:
        return number
    if issubclass(kind, float) and math.isfinite(real := float.__float__(value)):
        return real
    if issubclass(kind, str) and str.__len__(value) <= TEXT_CHARACTERS:
        text = str.__str__(value)
        if readable(text) == text:
            return text
    raise _OtherError


def _key(key: Any) -> str:
    if not issubclass(type(key), str):
        raise _OtherError
    text = str.__str__(key)
    if readable(text) != text:
        raise _OtherError
    return text
