"""Types of ports and blackboard entries, with the conversions that BehaviorTree.CPP makes between them.

A value is a plain Python object. Numbers, strings and booleans convert as BT.CPP's ``Any`` does; all other
values are passed by reference.
"""

import collections
import dataclasses
import enum
import functools
import json
import math
import numbers
import re
import sys
import typing
from collections.abc import Callable
from typing import Any, Final

from tree_gardener.status import Status
from tree_gardener.type_words import type_words

INT32: Final = (-(2**31), 2**31 - 1)
UINT32: Final = (0, 2**32 - 1)
INT64: Final = (-(2**63), 2**63 - 1)

_INTEGER = re.compile(r"-?[0-9]+")
_UNSIGNED = re.compile(r"[0-9]+")
_REAL = re.compile(
    r"-?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|inf(?:inity)?|nan(?:\(\w*\))?)",
    re.IGNORECASE | re.ASCII,
)
_TRUE = frozenset(("1", "true", "TRUE", "True"))
_FALSE = frozenset(("0", "false", "FALSE", "False"))


T = typing.TypeVar("T")


class SharedQueue(collections.deque[T]):
    """A queue of any objects that nodes share over the blackboard, as BehaviorTree.CPP's ``SharedQueue<T>``.

    Declare it as ``Port(SharedQueue[Pose])``. The Loop nodes and a LoopNode consume it in place. Adding and
    taking elements is safe from any thread.
    """


class ConversionError(ValueError):
    """A text or a value that does not have the requested type."""


@dataclasses.dataclass(frozen=True, eq=False)
class ValueType:
    """A type that a port or an entry can have.

    Attributes:
        name: as in ``catalog.json``: ``int``, ``double``, ``list[int]``; a Python class by its full name.
        parse: makes a value from a literal; raises ConversionError.
        convert: makes a value of this type from another value; raises ConversionError.
        is_strong: whether an entry of this type refuses others; ``any`` does not.
        from_json: makes a value from a JSON document, if the type was registered with one.
    """

    name: str
    parse: Callable[[str], Any]
    convert: Callable[[Any], Any]
    is_strong: bool = True
    from_json: Callable[[Any], Any] | None = None


def format_number(value: float) -> str:
    """Returns a number as text: an integer without decimals, a double always with six."""
    if isinstance(value, int):
        return str(int(value))
    if math.isnan(value):
        return "-nan" if math.copysign(1.0, value) < 0 else "nan"
    return f"{value:.6f}" if math.isfinite(value) else str(value)


def to_text(value: Any) -> str:
    """Returns a value in the form in which a string port reads it."""
    if issubclass(type(value), str):
        return value  # type: ignore[no-any-return]
    number = as_number(value)
    if number is not None:
        return format_number(number)
    write = _TO_TEXT.get(type(value))
    if write is None:
        raise ConversionError(f"{value_words(value)} is not a text")
    return write(value)


def as_number(value: Any) -> int | float | None:
    """Returns the value as an int (booleans too) or a float; None if it is not a number."""
    kind = type(value)  # not `isinstance`: it asks `__class__`, which may be the user's code
    if kind is bool:
        return int(value)
    if issubclass(kind, (int, float)):
        return value  # type: ignore[no-any-return]
    if issubclass(kind, numbers.Integral):
        return int(value)
    if issubclass(kind, numbers.Real):
        return float(value)
    return None


def _integer(limits: tuple[int, int], name: str) -> ValueType:
    low, high = limits
    pattern = _UNSIGNED if low == 0 else _INTEGER

    def parse(text: str) -> int:
        match = pattern.match(text)
        if match is None:
            raise ConversionError(f"'{text}' is not a whole number")
        return in_range(int(match.group()))

    def convert(value: Any) -> int:
        number = as_number(value)
        if number is None:
            if isinstance(value, str):
                return parse(value)
            raise ConversionError(f"{value_words(value)} is not a whole number")
        if isinstance(number, float):
            if not number.is_integer():
                raise ConversionError(f"{number} is not a whole number")
            number = int(number)
        return in_range(number)

    def in_range(number: int) -> int:
        if not low <= number <= high:
            raise ConversionError(f"{number} is outside of {low}..{high}")
        return number

    return ValueType(name, parse, convert)


def parse_double(text: str) -> float:
    """Reads a real number as C++ ``from_chars`` does: text after the number is ignored."""
    match = _REAL.match(text)
    if match is None:
        raise ConversionError(f"'{text}' is not a number")
    return checked_double(match.group())


def typed_constant(text: str) -> tuple[Any, ValueType | None]:
    """Returns the value of a constant for a SubTree, with its type; None for a text, whose entry has none.

    A number that neither an integer nor a double can hold is a text.
    """
    if _INTEGER.fullmatch(text):
        number = int(text)
        if INT64[0] <= number <= INT64[1]:
            return number, INT if INT32[0] <= number <= INT32[1] else INT_64
    if _REAL.fullmatch(text):
        try:
            return checked_double(text), DOUBLE
        except ConversionError:
            return text, None
    return text, None


def checked_double(text: str) -> float:
    """Converts a real number; refuses one that no double can hold, as ``from_chars`` does."""
    number = float(text.partition("(")[0])
    if math.isinf(number) and text[-1].isdigit():
        raise ConversionError(f"{text} is too large: the largest number is {sys.float_info.max:.3g}")
    if number == 0.0 and re.search("[1-9]", text.lower().partition("e")[0]):
        raise ConversionError(f"{text} is too small: the smallest above 0 is {math.ulp(0.0):.3g}")
    return number


def _convert_double(value: Any) -> float:
    number = as_number(value)
    if number is not None:
        return float(number)
    if isinstance(value, str):
        return parse_double(value)
    raise ConversionError(f"{value_words(value)} is not a number")


def parse_bool(text: str) -> bool:
    """Reads one of ``0 1 true TRUE True false FALSE False``."""
    if text in _TRUE:
        return True
    if text in _FALSE:
        return False
    raise ConversionError(f"'{text}' is not true or false")


def to_bool(value: Any) -> bool:
    """Casts to bool: an integer must be 0 or 1, a double must not be negative, a string is not a bool."""
    number = as_number(value)
    if number is None:
        raise ConversionError(f"{value_words(value)} is not true or false")
    if isinstance(number, int):
        if number not in (0, 1):
            raise ConversionError(f"the whole number {number} is neither 0 nor 1")
    elif number < 0:
        raise ConversionError(f"the negative number {number} is neither true nor false")
    return bool(number)


def _convert_bool(value: Any) -> bool:
    return parse_bool(value) if isinstance(value, str) else to_bool(value)


def parse_status(text: str) -> Status:
    """Reads the name of a status."""
    try:
        return Status[text]
    except KeyError:
        raise ConversionError(
            f"'{text}' is not a status: IDLE, RUNNING, SUCCESS, FAILURE or SKIPPED"
        ) from None


_BY_NUMBER: Final = tuple(sorted(Status, key=lambda status: status.number))


def status_of(value: Any) -> Status:
    """Returns a status that is given as such, by its name, or by its number."""
    if isinstance(value, Status):
        return value
    number = as_number(value)
    if number is None:
        return parse_status(to_text(value))
    if number not in range(len(_BY_NUMBER)):
        raise ConversionError(f"{format_number(number)} is no status: they have the numbers 0 to 4")
    return _BY_NUMBER[int(number)]


def _same(value: Any) -> Any:
    return value


INT: Final = _integer(INT32, "int")
INT_64: Final = _integer(INT64, "int64")
UINT: Final = _integer(UINT32, "uint")
DOUBLE: Final = ValueType("double", parse_double, _convert_double)
STRING: Final = ValueType("string", _same, to_text)
BOOL: Final = ValueType("bool", parse_bool, _convert_bool)
STATUS: Final = ValueType("status", parse_status, status_of)
ANY: Final = ValueType("any", _same, _same, is_strong=False)
POLYMORPHIC: Final = ValueType("any", _same, _same, is_strong=False)
"""The type of a port that gives an entry the type of the first value, as `AnyTypeAllowed` asks for."""


class AnyTypeAllowed:
    """The type of a polymorphic port, as in ``OUTPUT_PORTS = {"out": Port(AnyTypeAllowed)}``.

    As BehaviorTree.CPP's. An input takes any value, as with ``Any``. An output gives a new entry the type of
    the first value, which the entry keeps: later values are converted to it or refused. With ``Any`` an entry
    holds anything.
    """


def split_list(text: str) -> list[str]:
    """Returns the parts of a list; a separator at its end adds none."""
    return text.removesuffix(";").split(";") if text else []


@functools.cache
def _list_of(item: ValueType) -> ValueType:
    def parse(text: str) -> list[Any]:
        if text.startswith("json:"):
            try:
                values = json.loads(text[len("json:") :])
            except ValueError as error:
                raise ConversionError(f"'{text}' is not JSON: {error}") from None
            if not isinstance(values, list):
                raise ConversionError(f"'{text}' is not a list")
            return [(item.from_json or item.convert)(value) for value in values]
        return [item.parse(part) for part in split_list(text)]

    def convert(value: Any) -> Any:
        if isinstance(value, str):
            return parse(value)
        if isinstance(value, (list, tuple, collections.deque)):
            return value
        raise ConversionError(f"{value_words(value)} is not a list")

    return ValueType(f"list[{item.name}]", parse, convert)


BY_NAME: Final[dict[str, ValueType]] = {
    kind.name: kind
    for kind in (
        *(INT, INT_64, UINT, DOUBLE, STRING, BOOL, STATUS, ANY),
        *(_list_of(item) for item in (INT, INT_64, UINT, DOUBLE, STRING, BOOL)),
    )
} | {"script": STRING}

_BY_CLASS: dict[Any, ValueType] = {
    int: INT,
    float: DOUBLE,
    str: STRING,
    bool: BOOL,
    Status: STATUS,
    Any: ANY,
    AnyTypeAllowed: POLYMORPHIC,
    object: ANY,
    None: ANY,
}


_TO_TEXT: dict[type, Callable[[Any], str]] = {}
"""How values of registered classes become text."""


def set_type(cls: type, kind: ValueType, to_text: Callable[[Any], str] | None) -> None:
    """Makes `kind` the type of a class in ports; `to_text` makes a text of a value."""
    _BY_CLASS[cls] = kind
    _TO_TEXT.pop(cls, None)
    if to_text is not None:
        _TO_TEXT[cls] = to_text


def value_type(annotation: Any) -> ValueType:
    """Returns the type of a Python annotation, as in ``Port(list[float])``.

    A name of ``catalog.json`` means the type of that name. Any other class is a separate type: its values are
    passed by reference, and it has no literals, except for an Enum, whose members are written by name, and
    for a class that was registered with `register_type`.
    """
    if isinstance(annotation, ValueType):
        return annotation
    if isinstance(annotation, str):
        return BY_NAME.get(annotation, ANY)
    known = _BY_CLASS.get(annotation)
    if known is None:
        known = _BY_CLASS[annotation] = _make_type(annotation)
    return known


def _make_type(annotation: Any) -> ValueType:
    if typing.get_origin(annotation) in (list, collections.deque, SharedQueue):
        item = value_type(typing.get_args(annotation)[0])
        return BY_NAME.get(f"list[{item.name}]") or _list_of(item)
    if annotation in (list, collections.deque):
        return BY_NAME["list[string]"]
    if annotation is SharedQueue:
        return queue_type(Any)
    if isinstance(annotation, type) and issubclass(annotation, enum.Enum):
        return _enumeration(annotation)
    if isinstance(annotation, type):
        return _class(annotation)
    return ANY


def queue_type(element: Any) -> ValueType:
    """Returns the type of a loop's queue: it reads literals of its elements, and takes any entry."""
    item = value_type(element)
    return dataclasses.replace(BY_NAME.get(f"list[{item.name}]") or _list_of(item), is_strong=False)


def _enumeration(cls: type[enum.Enum]) -> ValueType:
    def parse(text: str) -> enum.Enum:
        if text in cls.__members__:
            return cls[text]
        for member in cls:
            if str(member.value) == text:
                return member
        raise ConversionError(f"'{text}' is not one of {', '.join(cls.__members__)}")

    def convert(value: Any) -> enum.Enum:
        if isinstance(value, cls):
            return value
        number = as_number(value)  # scripts compute with doubles
        is_whole = isinstance(number, float) and number.is_integer()
        return parse(str(int(value)) if is_whole else to_text(value))

    return ValueType(f"{cls.__module__}.{cls.__qualname__}", parse, convert)


def _class(cls: type) -> ValueType:
    def parse(text: str) -> Any:
        raise ConversionError(f"'{text}': a {cls.__qualname__} cannot be written as text, use a {{key}}")

    def convert(value: Any) -> Any:
        if isinstance(value, cls):
            return value
        raise ConversionError(f"{value_words(value)} is not a {cls.__qualname__}")

    return ValueType(f"{cls.__module__}.{cls.__qualname__}", parse, convert)


def type_of_value(value: Any) -> ValueType:
    """Returns the type that an entry gets from a value that a polymorphic port writes."""
    if value is None:
        return ANY
    if isinstance(value, list):
        # Lists of lists have no type; one may hold itself.
        item = ANY if not value or isinstance(value[0], list) else type_of_value(value[0])
        return BY_NAME.get(f"list[{item.name}]", ANY)
    number = None if isinstance(value, enum.Enum) else as_number(value)
    if isinstance(value, bool) or number is None:
        return value_type(type(value))
    if isinstance(number, float):
        return DOUBLE
    return INT if INT32[0] <= number <= INT32[1] else INT_64


def type_name_of(value: Any) -> str:
    """Returns the type of a value for messages: ``int``, ``double``, ``string``, ``bool``, or its class."""
    kind = type(value)
    if kind is bool:
        return "bool"
    if issubclass(kind, int):
        return "int"
    if issubclass(kind, float):
        return "double"
    if issubclass(kind, str):
        return "string"
    return kind.__qualname__


def value_words(value: Any) -> str:
    """Returns what a value is, in words: ``a whole number``, ``a value of type Spot``."""
    return type_words(type_name_of(value))
