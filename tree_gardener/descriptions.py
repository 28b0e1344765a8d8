"""Short texts of users' values and exceptions, whatever they are and whatever their methods do.

Classes are read by ``type(value)``: `isinstance` asks ``value.__class__``, which may be the user's code.
"""

import array
import collections
import dataclasses
import itertools
import math
import traceback
from collections.abc import Callable, Iterable
from operator import attrgetter
from sys import gettrace, settrace  # a debugger replaces the one in `sys` by one that warns
from types import FrameType, TracebackType
from typing import Any, Final

__all__ = ["as_text", "equals", "error_text", "readable", "shortened", "text_of", "traceback_text"]

LONGEST: Final = 500
LONGEST_ERROR: Final = 4_000
LONGEST_TRACEBACK: Final = 100_000
_ITEMS: Final = 10
_ARRAY_ITEMS: Final = 20
_LEVELS: Final = 3
_TEXT: Final = 200
_SORTED: Final = 1_000
_MOST_STEPS: Final = 100_000
"""So many instructions of users' methods run for one text. They are counted: equal runs have equal texts."""
_RAISED: Final = (Exception, SystemExit, GeneratorExit)
"""What a user's method may raise; Ctrl-C and the end of a hanging action pass."""
_BITS: Final = 1_000
_PLAIN: Final = (int, str, bytes, bytearray, memoryview, array.array)
_SETS: Final = (set, frozenset)
_BRACKETS: Final[dict[type, tuple[str, str]]] = {
    dict: ("{", "}"),
    list: ("[", "]"),
    tuple: ("(", ")"),
    set: ("{", "}"),
    frozenset: ("frozenset({", "})"),
    collections.deque: ("deque([", "])"),
}


class _EndlessError(BaseException):
    """Raised in a method of the user that does not end. Users may catch every `Exception`."""


def text_of(value: Any, longest: int = LONGEST) -> str:
    """Returns a short text that shows a value, as `repr`."""
    if type(value) is str:
        return readable(shortened(repr(value[:longest]), longest))
    return _guarded(value, longest, "repr", lambda text: text.of(value, _LEVELS))


def as_text(value: Any, longest: int = LONGEST) -> str:
    """Returns a short text of a value as `print` writes it."""
    if type(value) in _BRACKETS:
        return text_of(value, longest)
    return _guarded(value, longest, "text", lambda text: text.call(str, value))


def equals(one: Any, other: Any) -> bool:
    """Returns whether two values are equal; those whose comparison raises or does not end are not."""
    try:
        return bool(_Description().call(lambda _: bool(one == other), None))
    except (_EndlessError, *_RAISED):
        return False


def error_text(error: BaseException) -> str:
    """Returns the text of an exception, which its class makes."""
    return _guarded(error, LONGEST_ERROR, "text", lambda text: text.call(str, error))


def traceback_text(error: BaseException, trace: TracebackType | None = None) -> str:
    """Returns the traceback of an exception, from its own beginning or a later one, at bounded length."""
    trace = error.__traceback__ if trace is None else trace
    if not all(_has_text(each) for each in _chain(error)):  # `traceback` would wait for it
        last = f"{_name(error)}: {error_text(error)}\n"
        text = "".join(["Traceback (most recent call last):\n", *traceback.format_tb(trace), last])
    else:
        text = "".join(traceback.format_exception(type(error), error, trace))
    if len(text) > LONGEST_TRACEBACK:
        half = LONGEST_TRACEBACK // 2
        text = f"{text[:half]}\n…\n{text[-half:]}"
    return readable(text)


def _chain(error: BaseException) -> list[BaseException]:
    found: list[BaseException] = []
    one: BaseException | None = error
    while one is not None and all(one is not each for each in found):
        found.append(one)
        one = one.__cause__ or one.__context__
    return found


def _has_text(error: BaseException) -> bool:
    try:
        _Description().call(str, error)
    except (_EndlessError, *_RAISED):
        return False
    return True


def _guarded(value: object, longest: int, what: str, make: Callable[["_Description"], Any]) -> str:
    try:
        return readable(shortened(str(make(_Description())), longest))
    except _EndlessError:
        return f"<{_name(value)}; its {what} does not end>"
    except _RAISED as error:
        return f"<{_name(value)}; its {what} raised {_name(error)}>"


def shortened(text: str, longest: int) -> str:
    """Returns the start of a text that is too long."""
    return text if len(text) <= longest else f"{text[: longest - 1]}…"


def readable(text: str) -> str:
    """Returns a text that UTF-8 can hold: half of a character is written as its number."""
    return text if text.isascii() else text.encode("utf-8", "backslashreplace").decode()


class _Description:
    """Makes one text, with a limited number of instructions of users' methods."""

    def __init__(self) -> None:
        self._left = _MOST_STEPS

    def of(self, value: Any, levels: int) -> str:
        """Returns the text of a value; containers are opened so many levels deep."""
        kind: Any = type(value)
        if kind in _PLAIN:
            return _plain(value)
        base = next((each for each in _BRACKETS if kind.__repr__ is each.__repr__), None)
        if base is not None:
            return self._container(value, base, levels)
        if (names := _fields(kind)) is not None:
            return self._with_fields(value, kind, names, levels)
        if kind.__repr__ is object.__repr__ and not hasattr(kind, "dtype"):
            return f"<{kind.__module__}.{kind.__qualname__} object>"  # addresses differ from run to run
        return str(self.call(_shown, value))

    def call(self, function: Callable[[Any], Any], value: Any) -> Any:
        """Calls a function that may run a user's method, and ends it when it runs too long."""

        def count(frame: FrameType, _event: str, _arg: object) -> Any:
            frame.f_trace_opcodes = True  # `while True: pass` stays within one line
            self._left -= 1
            if self._left < 0:
                raise _EndlessError
            return count

        before = gettrace()
        settrace(count)
        try:
            return function(value)
        finally:
            settrace(before)

    def _container(self, value: Any, base: Any, levels: int) -> str:
        """Returns the text of a list, or another container, or of one of a derived class."""
        count = base.__len__(value)
        opening, closing = _BRACKETS[base] if count or base not in _SETS else (base.__name__, "()")
        if not levels and count:
            return f"{opening}…{closing}"
        if base is dict:
            pairs = itertools.islice(dict.items(value), _ITEMS)
            texts = [f"{self.of(key, levels - 1)}: {self.of(each, levels - 1)}" for key, each in pairs]
        elif base in _SETS:
            if count > _SORTED:
                return f"{base.__name__} of {count} items"
            texts = sorted(self.of(each, levels - 1) for each in base.__iter__(value))
        else:
            texts = [self.of(each, levels - 1) for each in itertools.islice(base.__iter__(value), _ITEMS)]
        comma = "," if base is tuple and count == 1 else ""
        return f"{opening}{_joined(texts, count)}{comma}{closing}"

    def _with_fields(self, value: Any, kind: type, names: Iterable[str], levels: int) -> str:
        name = _full_name(kind)
        if levels <= 0:
            return f"{name}(…)"
        below = levels if _is_message(kind) else levels - 1  # a message holds no message of its own class
        texts = [f"{each}={self.of(self.call(attrgetter(each), value), below)}" for each in names]
        return f"{name}({', '.join(texts)})"


def _plain(value: Any) -> str:
    """Returns the text of a value that holds no other objects."""
    kind = type(value)
    if kind is int:
        return repr(value) if value.bit_length() <= _BITS else f"int of {value.bit_length()} bits"
    if kind is array.array:
        return f"[{_joined([repr(each) for each in value[:_ITEMS]], len(value))}]"
    if len(value) <= _TEXT:
        return repr(value)
    return f"{value[:_TEXT]!r}…" if kind is str else f"{kind.__name__} of {len(value)} bytes"


def _name(value: object) -> str:
    return type(value).__name__


def _joined(texts: list[str], count: int) -> str:
    return ", ".join([*texts[:_ITEMS], *(["…"] if count > _ITEMS else [])])


def _fields(kind: type) -> list[str] | None:
    """Returns the fields of a ROS message but pictures, or of a dataclass without its own `__repr__`."""
    if _is_message(kind):
        names = list(vars(kind)["_fields_and_field_types"])
        return None if {"width", "height"} <= set(names) else names
    made = vars(kind).get("__repr__")
    if dataclasses.is_dataclass(kind) and hasattr(made, "__wrapped__"):
        return [field.name for field in dataclasses.fields(kind) if field.repr]
    return None


def _is_message(kind: type) -> bool:
    return "_fields_and_field_types" in vars(kind)


def _full_name(kind: type) -> str:
    """Returns the name of a class as its own `__repr__` writes it."""
    if _is_message(kind):
        return f"{kind.__module__.rpartition('.')[0]}.{kind.__name__}"
    return kind.__qualname__


def _shown(value: Any) -> str:
    """Returns the text of a value of another class; large arrays and pictures are named, not written."""
    shape, items = getattr(value, "shape", None), getattr(value, "dtype", None)
    if type(shape) is tuple and items is not None and math.prod(shape) > _ARRAY_ITEMS:
        return f"array {'×'.join(map(str, shape))} of {items}"
    if _is_message(type(value)):
        return f"{_name(value)} {value.width}×{value.height}"
    return repr(value)
