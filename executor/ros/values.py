"""Converts ROS messages to plain JSON values and back; every field is checked before ROS receives it."""

from __future__ import annotations

import array
import math
import re
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Final

import numpy as np

__all__ = ["FieldError", "Flattened", "describe", "fill", "flatten", "message_type", "type_name"]

LARGEST_LIST: Final = 400
LARGEST_TEXT: Final = 4000
MOST_VALUES: Final = 4000
_TYPE_NAME: Final = re.compile(r"([a-z][a-z0-9_]*)/(?:msg/)?([A-Z][A-Za-z0-9]*)")
_LIST: Final = re.compile(r"sequence<(.+?)(?:, (\d+))?>|(.+)\[(\d+)\]")
_WHOLE: Final = re.compile(r"(u?)int(8|16|32|64)")
_LARGEST: Final = {"float": float(np.finfo(np.float32).max), "double": float(np.finfo(np.float64).max)}
_WORDS: Final = {"inf": math.inf, "-inf": -math.inf, "nan": math.nan}


class FieldError(ValueError):
    """A value does not fit its field; the text begins with the field's path."""


def message_type(name: str) -> Any:
    """Returns the class of a message type such as `std_msgs/msg/String`, also written `std_msgs/String`.

    Raises:
        ValueError: it is not installed, or not a valid name.
    """
    match = _TYPE_NAME.fullmatch(name)
    if match is None:
        raise ValueError(f"{name!r} is no message type; write it as in std_msgs/msg/String")
    try:
        return getattr(import_module(f"{match[1]}.msg"), match[2])
    except (ImportError, AttributeError) as error:
        raise ValueError(f"the message type {name!r} is not installed") from error


def type_name(kind: type) -> str:
    """Returns the name of a message type, such as `sensor_msgs/msg/LaserScan`."""
    return f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}"


@dataclass
class Flattened:
    """A message as dicts, lists and numbers.

    `cut` holds the true lengths of shortened values, by their path.
    """

    value: Any = None
    cut: dict[str, int] = field(default_factory=dict)
    _left: int = MOST_VALUES

    def of(self, item: Any, path: str) -> Any:
        """Returns one value as a plain value; `path` is its place in the message."""
        if hasattr(item, "get_fields_and_field_types"):
            start = f"{path}." if path else ""
            return {name: self.of(getattr(item, name), start + name) for name in _fields(item)}
        if isinstance(item, array.array | np.ndarray | list | tuple):
            return self._of_list(item, path)
        self._left -= 1
        if isinstance(item, bytes):  # an octet
            return item[0]
        if isinstance(item, str) and len(item) > LARGEST_TEXT:
            self.cut[path] = len(item)
            return item[:LARGEST_TEXT]
        return item.item() if isinstance(item, np.generic) else item

    def _of_list(self, items: Any, path: str) -> list[Any]:
        result: list[Any] = []
        for index, item in enumerate(items[:LARGEST_LIST]):
            if self._left <= 0:
                break
            result.append(self.of(item, f"{path}[{index}]"))
        if len(result) < len(items):
            self.cut[path] = len(items)
        return result


def flatten(message: Any) -> Flattened:
    """Returns a message as plain values, of a bounded size."""
    flattened = Flattened()
    flattened.value = flattened.of(message, "")
    return flattened


def describe(name: str) -> dict[str, Any]:
    """Returns a type's fields with their types, and a message with their defaults, as plain values.

    Raises:
        ValueError: the type is not installed, or its name is invalid.
    """
    kind = message_type(name)
    return {"fields": dict(kind.get_fields_and_field_types()), "example": flatten(kind()).value}


def _fields(message: Any) -> dict[str, str]:
    fields: dict[str, str] = message.get_fields_and_field_types()
    return fields


def fill(message: Any, values: Any, path: str = "") -> None:
    """Sets a message's fields from plain values; fields that are missing in `values` are not changed.

    Raises:
        FieldError: there is no such field, or a value does not fit.
    """
    if not isinstance(values, dict):
        raise _misfit(path, "an object with fields", values)
    known = _fields(message)
    start = f"{path}." if path else ""
    for name, value in values.items():
        if name not in known:
            kind = type(message).__name__
            raise FieldError(f"{start}{name}: {kind} has no field {name!r}; it has {', '.join(known)}")
        setattr(message, name, _converted(known[name], value, start + name))


def _converted(kind: str, value: Any, path: str) -> Any:
    if (match := _LIST.fullmatch(kind)) is not None:
        return _converted_list(match, value, path)
    if "/" in kind:
        inner = message_type(kind)()
        fill(inner, value, path)
        return inner
    return _converted_scalar(kind, value, path)


def _converted_scalar(kind: str, value: Any, path: str) -> Any:
    if kind in {"float", "double"}:
        return _number(value, _LARGEST[kind], path)
    if kind in {"boolean", "bool"}:
        if not isinstance(value, bool):
            raise _misfit(path, "true or false", value)
        return value
    if kind == "octet":
        return bytes([_whole(value, 0, 255, path)])
    if (whole := _WHOLE.fullmatch(kind)) is not None:
        bits = int(whole[2])
        low, high = (0, 2**bits - 1) if whole[1] else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
        return _whole(value, low, high, path)
    return _text(kind, value, path)


def _converted_list(match: re.Match[str], value: Any, path: str) -> list[Any]:
    kind, limit, exact = match[1] or match[3], match[2], match[4]
    if not isinstance(value, list):
        raise _misfit(path, "a list", value)
    if exact is not None and len(value) != int(exact):
        raise FieldError(f"{path}: must have {exact} values, not {len(value)}")
    if limit is not None and len(value) > int(limit):
        raise FieldError(f"{path}: must have at most {limit} values, not {len(value)}")
    return [_converted(kind, item, f"{path}[{index}]") for index, item in enumerate(value)]


def _number(value: Any, largest: float, path: str) -> float:
    if isinstance(value, str) and value in _WORDS:
        return _WORDS[value]
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _misfit(path, "a number", value)
    if abs(value) > largest:
        raise FieldError(f"{path}: is larger than {largest:.3g}, the most that this field can hold")
    return float(value)


def _whole(value: Any, low: int, high: int, path: str) -> int:
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int):
        raise _misfit(path, "a whole number", value)
    if not low <= value <= high:
        raise FieldError(f"{path}: must be from {low} to {high}, not {value}")
    return value


def _text(kind: str, value: Any, path: str) -> str:
    if not isinstance(value, str):
        raise _misfit(path, "text", value)
    limit = kind.partition("<")[2].removesuffix(">")
    if limit.isdigit() and len(value) > int(limit):
        raise FieldError(f"{path}: must have at most {limit} characters, not {len(value)}")
    if "\0" in value:
        raise FieldError(f"{path}: must not contain the character NUL")
    return value


def _misfit(path: str, wanted: str, value: Any) -> FieldError:
    names = {dict: "an object", list: "a list", str: "text", bool: "true or false", type(None): "null"}
    given = names.get(type(value), "a number")
    shown = f" {value!r}"[:40] if isinstance(value, str | int | float) else ""
    return FieldError(f"{path or 'message'}: must be {wanted}, not {given}{shown}")
