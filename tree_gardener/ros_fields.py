"""Checks of the fields of ROS messages: switched on, and their errors as sentences.

ROS 2's Python classes check the type of a field only if ``ROS_PYTHON_CHECK_FIELDS`` is 1 when the module of
the class is loaded. Otherwise a wrong value is sent as garbage, or ends the process within the middleware.
"""

import difflib
import os
import sys
from types import TracebackType
from typing import Any, Final

from tree_gardener.descriptions import text_of

__all__ = ["VARIABLE", "check_fields", "field_problem", "is_message_module", "users_frames"]

VARIABLE: Final = "ROS_PYTHON_CHECK_FIELDS"
_FLAG: Final = "ros_python_check_fields"
"""The name in the module of a message, which each new message asks."""
_LIMITS: Final = {f"{sign}int{bits}": bits for sign in ("", "u") for bits in (8, 16, 32, 64)}
_REALS: Final = ("float", "double")


def check_fields() -> None:
    """Makes all messages of this process check their fields, also those of classes that are loaded.

    Where the variable is 0, the user wants no checks.
    """
    if os.environ.get(VARIABLE) == "0":
        return
    os.environ[VARIABLE] = "1"
    for module in list(sys.modules.values()):
        if is_message_module(module):
            setattr(module, _FLAG, "1")


def is_message_module(module: object) -> bool:
    """Returns whether a module holds a message class that can check its fields."""
    return _FLAG in getattr(module, "__dict__", ())


def field_problem(error: BaseException) -> str:
    """Returns what is wrong with a field, and what to write; "" if the exception is another one."""
    trace = error.__traceback__ if type(error) is AssertionError else None
    frame = None
    while trace is not None:
        frame, trace = trace.tb_frame, trace.tb_next
    if frame is None or _FLAG not in frame.f_globals:
        return ""
    message, field = frame.f_locals.get("self"), frame.f_code.co_name
    fields: dict[str, str] = getattr(type(message), "_fields_and_field_types", {})
    if field == "__init__":
        return _unknown(message, fields, frame.f_locals.get("kwargs", {}))
    if field not in fields or "value" not in frame.f_locals:
        return ""
    kind, value = fields[field], frame.f_locals["value"]
    given = "None" if value is None else f"the {type(value).__name__} {text_of(value, 80)}"
    return f"{_name(message)}.{field} takes {_wanted(kind)}, not {given}: {_remedy(kind, value)}"


def users_frames(trace: TracebackType | None) -> list[tuple[str, int]]:
    """Returns file and line of each frame of a traceback but those of messages."""
    found = []
    while trace is not None:
        if _FLAG not in trace.tb_frame.f_globals:
            found.append((trace.tb_frame.f_code.co_filename, trace.tb_lineno or 0))
        trace = trace.tb_next
    return found


def _unknown(message: Any, fields: dict[str, str], given: dict[str, Any]) -> str:
    unknown = next((name for name in given if name not in fields), "")
    near = difflib.get_close_matches(unknown, fields, 1)
    hint = f"write {near[0]}" if near else f"it has {', '.join(fields)}"
    return f"{_name(message)} has no field '{unknown}': {hint}"


def _name(message: Any) -> str:
    kind = type(message)
    return f"{kind.__module__.partition('.')[0]}/{kind.__name__}"


def _wanted(kind: str) -> str:
    if kind in _REALS:
        return "a float"
    if kind in _LIMITS:
        low, high = _range(kind)
        return f"an int from {low} to {high}"
    plain = {"boolean": "True or False", "octet": "one byte", "string": "a str", "wstring": "a str"}
    if kind in plain:
        return plain[kind]
    if kind.startswith("sequence<"):
        return f"a list of {kind[9:-1].partition(',')[0]}"
    if kind.endswith("]"):
        return f"{kind.rpartition('[')[2][:-1]} values of {kind.rpartition('[')[0]}"
    return f"a message {kind}"


def _range(kind: str) -> tuple[int, int]:
    bits = _LIMITS[kind]
    return (0, 2**bits - 1) if kind[0] == "u" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


def _remedy(kind: str, value: Any) -> str:
    """Returns what to write in place of a value."""
    if value is None:
        return "give it a value"
    if kind.startswith("sequence<") or kind.endswith("]") or kind in _REALS or kind in _LIMITS:
        return (_number_remedy if kind in _REALS or kind in _LIMITS else _items_remedy)(kind, value)
    given = type(value)
    package, slash, name = kind.partition("/")
    if slash:
        made = f"make one with {name}(…) of {package}.msg"
        return "write ….to_msg()" if hasattr(given, "to_msg") else made
    if kind == "boolean":
        return f"write {bool(value)}" if given is int else "write bool(…)"
    if given is bytes:
        return "write ….decode()"
    return "write bytes([…])" if kind == "octet" else f"write '{value}'" if given is int else "write str(…)"


def _number_remedy(kind: str, value: Any) -> str:
    given = type(value)
    if kind in _REALS:
        if given is float:
            return "it must fit into 32 bits, at most 3.4e38"
        return f"write {float(value)}" if given is int and abs(value) < 2**53 else "write float(…)"
    low, high = _range(kind)
    if given is int:
        return "the number does not fit"
    is_whole = given is float and value.is_integer() and low <= value <= high
    return f"write {int(value)}" if is_whole else "write int(…)"


def _items_remedy(kind: str, value: Any) -> str:
    item = kind[9:-1].partition(",")[0] if kind.startswith("sequence<") else kind.rpartition("[")[0]
    count = f"{kind.rpartition('[')[2][:-1]} of them: " if kind.endswith("]") else ""
    if hasattr(type(value), "tolist") and hasattr(type(value), "astype"):
        python = "float" if item in _REALS else "int"
        return f"{count}write ….astype({python}).tolist()"
    python = "float" if item in _REALS else "int" if item in _LIMITS else "str" if "string" in item else ""
    return f"{count}write [{python}(each) for each in …]" if python else f"{count}each must be a {item}"
