"""The fields of ROS messages by path: their types, and values from texts of ports.

A path is written with two underscores between the names, ``pose__position__x``. No field of ROS contains two
underscores, and BehaviorTree.CPP accepts no dot in a name. A quaternion has also the field ``yaw``.
"""

import array
import importlib
import json
import math
import re
from collections.abc import Sequence
from typing import Any, Final

from tree_gardener.errors import PortError
from tree_gardener.spelling import nearest
from tree_gardener.values import ConversionError, to_bool

SEPARATOR: Final = "__"
YAW: Final = "yaw"
QUATERNION: Final = "geometry_msgs/Quaternion"
TIMES: Final = ("builtin_interfaces/Time", "builtin_interfaces/Duration")
NOW: Final = "now"
JSON: Final = "json:"

_TYPE: Final = re.compile(r"([a-z]\w*)/(?:(msg|srv|action)/)?([A-Z]\w*)")
_LIST: Final = re.compile(r"sequence<(.+?)(?:, (\d+))?>|(.+)\[(\d+)\]")
_WHOLE: Final = re.compile(r"(u?)int(8|16|32|64)")
_EXAMPLE: Final = {
    "msg": "geometry_msgs/msg/Twist",
    "srv": "std_srvs/srv/Trigger",
    "action": "nav2_msgs/action/NavigateToPose",
}


def interface(name: str, kind: str) -> Any:
    """Returns the class of an interface such as ``nav2_msgs/action/NavigateToPose``.

    Args:
        name: the name; ``nav2_msgs/NavigateToPose`` is the same.
        kind: ``msg``, ``srv`` or ``action``.

    Raises:
        PortError: the name is malformed or of another kind, or the interface is not installed.
    """
    match = _TYPE.fullmatch(name.strip())
    if match is None or match[2] not in {None, kind}:
        raise PortError(f"'{name}' is no type of this kind; write it as {_EXAMPLE[kind]}")
    module = f"{match[1]}.{kind}"
    try:
        found = importlib.import_module(module)
    except ImportError:
        raise PortError(
            f"the type '{name}' is not installed: there is no package '{match[1]}' with .{kind} interfaces; "
            "install it, or choose another type"
        ) from None
    cls = getattr(found, match[3], None)
    if cls is None:
        near = nearest(match[3], [each for each in dir(found) if each[:1].isupper()])
        hint = f"; did you mean {match[1]}/{kind}/{near}?" if near else ""
        raise PortError(f"the package '{match[1]}' has no {kind} '{match[3]}'{hint}")
    return cls


def path_of(port: str) -> list[str]:
    """Returns the path that a port names: ``goal__pose`` is ``["goal", "pose"]``."""
    return port.split(SEPARATOR)


def type_at(message: Any, path: Sequence[str]) -> str:
    """Returns the type of the field at a path, as ROS writes it: ``double``, ``geometry_msgs/Pose``.

    Raises:
        PortError: there is no such field.
    """
    owner, kind = message, name_of(message)
    for index, name in enumerate(path):
        if kind == QUATERNION and name == YAW and index == len(path) - 1:
            return "double"
        if "/" not in kind or "<" in kind or "[" in kind:
            raise PortError(f"'{'.'.join(path[:index])}' is of the type {kind} and has no fields")
        if index:
            owner = getattr(owner, path[index - 1])
        known = owner.get_fields_and_field_types()
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean {near}?" if near else f"its fields: {', '.join(known) or 'none'}"
            raise PortError(f"{name_of(owner)} has no field '{name}'; {hint}")
        kind = known[name]
    return kind


def name_of(message: Any) -> str:
    """Returns the name of a message's type, as ``geometry_msgs/Pose``."""
    cls = message if isinstance(message, type) else type(message)
    return f"{cls.__module__.split('.')[0]}/{cls.__name__}"


def assign(message: Any, path: Sequence[str], value: Any, now_s: float = 0.0) -> Any:
    """Sets the field at a path to a value, which may be the text of a port; returns the message.

    Args:
        message: the message; an empty path replaces it by the value.
        path: the names of the fields.
        value: a text, a number, a list, a dict, or a message of the field's type.
        now_s: the time that the text ``now`` stands for.

    Raises:
        PortError: there is no such field, or the value does not suit it.
    """
    if not path:
        return _nested(type(message), value, name_of(message), now_s)
    kind = type_at(message, path)
    owner = message
    for name in path[:-1]:
        owner = getattr(owner, name)
    label = ".".join(path)
    if path[-1] == YAW and name_of(owner) == QUATERNION:
        yaw = _number(value, label)
        owner.x, owner.y, owner.z, owner.w = 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)
        return message
    try:
        setattr(owner, path[-1], convert(kind, value, label, now_s))
    except (AssertionError, OverflowError, TypeError, ValueError) as error:  # rclpy's own checks of a field
        raise PortError(f"{label} is {kind}: {value!r} does not suit it ({error})") from None
    return message


def read(message: Any, path: Sequence[str]) -> Any:
    """Returns the value at a path; lists of numbers as lists.

    Raises:
        PortError: there is no such field.
    """
    if path:
        type_at(message, path)
    value = message
    for name in path:
        if name == YAW and name_of(value) == QUATERNION:
            return math.atan2(
                2 * (value.w * value.z + value.x * value.y), 1 - 2 * (value.y * value.y + value.z * value.z)
            )
        value = getattr(value, name)
    if isinstance(value, array.array) or hasattr(value, "tolist"):
        return value.tolist()
    return value[0] if isinstance(value, bytes) else value


def convert(kind: str, value: Any, label: str, now_s: float = 0.0) -> Any:  # noqa: PLR0911 - a table of types
    """Returns a value of a field's type.

    Raises:
        PortError: the value does not suit the type.
    """
    listed = _LIST.fullmatch(kind)
    if listed is not None:
        return _items(listed, value, label, now_s)
    if "/" in kind:
        package, _, name = kind.partition("/")
        return _nested(interface(f"{package}/msg/{name}", "msg"), value, label, now_s)
    if kind in {"float", "double"}:
        return _number(value, label)
    if kind in {"boolean", "bool"}:
        try:
            return to_bool(value) if not isinstance(value, str) else _flag(value)
        except ConversionError as error:
            raise PortError(f"{label}: {error}; write true or false") from None
    if kind == "octet":
        return bytes([_whole(value, 0, 255, label)])
    if (whole := _WHOLE.fullmatch(kind)) is not None:
        bits = int(whole[2])
        low, high = (0, 2**bits - 1) if whole[1] else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
        return _whole(value, low, high, label)
    return value if isinstance(value, str) else str(value)


def _nested(cls: Any, value: Any, label: str, now_s: float) -> Any:
    """Returns a message: the value itself, or one made of a dict, of JSON, or of seconds."""
    if isinstance(value, cls):
        return value
    name = name_of(cls)
    if name in TIMES:
        seconds = now_s if value == NOW and name == TIMES[0] else _number(value, label)
        whole = math.floor(seconds)
        return cls(sec=whole, nanosec=min(999_999_999, round((seconds - whole) * 1e9)))
    if isinstance(value, str) and value.startswith(JSON):
        try:
            value = json.loads(value[len(JSON) :])
        except ValueError as error:
            raise PortError(f"{label}: this is not JSON: {error}") from None
    if not isinstance(value, dict):
        given = type(value).__name__ if not isinstance(value, str) else f"'{value}'"
        raise PortError(
            f"{label} is {name}: {given} does not suit it; "
            "give an entry of this type, or json: with its fields"
        )
    made = cls()
    for field, item in value.items():
        assign(made, [field], item, now_s)
    return made


def _items(kind: "re.Match[str]", value: Any, label: str, now_s: float) -> list[Any]:
    inner, limit, exact = kind[1] or kind[3], kind[2], kind[4]
    if isinstance(value, str):
        if value.startswith(JSON):
            try:
                value = json.loads(value[len(JSON) :])
            except ValueError as error:
                raise PortError(f"{label}: this is not JSON: {error}") from None
        else:
            value = value.split(";") if value else []
    if not isinstance(value, Sequence | array.array) and not hasattr(value, "__len__"):
        raise PortError(f"{label} is a list: {value!r} does not suit it; write 1;2;3")
    if exact is not None and len(value) != int(exact):
        raise PortError(f"{label} has {exact} values, not {len(value)}")
    if limit is not None and len(value) > int(limit):
        raise PortError(f"{label} has at most {limit} values, not {len(value)}")
    return [convert(inner, item, f"{label}[{index}]", now_s) for index, item in enumerate(value)]


def _number(value: Any, label: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise PortError(f"{label} is a number: {value!r} does not suit it") from None


def _whole(value: Any, low: int, high: int, label: str) -> int:
    number = _number(value, label)
    if not number.is_integer():
        raise PortError(f"{label} is a whole number: {value!r} does not suit it")
    whole = int(value) if isinstance(value, str) and value.strip().lstrip("+-").isdigit() else int(number)
    if not low <= whole <= high:
        raise PortError(f"{label} is from {low} to {high}: {value} does not suit it")
    return whole


def _flag(text: str) -> bool:
    flags = {"true": True, "1": True, "false": False, "0": False}
    found = flags.get(text.strip().lower())
    if found is None:
        raise ConversionError(f"'{text}' is neither true nor false")
    return found
