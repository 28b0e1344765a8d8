"""The interfaces of ROS that blocks may use: names, and fields as ports.

Those that are installed here are read from their files. A web server of a team has no ROS: there,
`ros_interfaces.json` names what the sessions have. `make generate` writes it.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from translator.catalog import PortModel
from translator.installed_interfaces import PARTS, installed, installed_fields, part_class

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

TABLE: Final = Path(__file__).with_name("ros_interfaces.json")
SEPARATOR: Final = "__"
MOST_FIELDS: Final = 600
DEEPEST: Final = 8

_NAME: Final = re.compile(r"([a-z]\w*)/(?:(msg|srv|action)/)?([A-Z]\w*)")
_LIST: Final = re.compile(r"sequence<(.+?)(?:, \d+)?>|(.+)\[\d+\]")
_WRITTEN: Final = {"result", "feedback", "response"}
_SCALARS: Final = {
    **dict.fromkeys(("float", "double"), "double"),
    **dict.fromkeys(("boolean", "bool"), "bool"),
    **dict.fromkeys(("int8", "int16", "int32"), "int"),
    **dict.fromkeys(("uint8", "uint16", "uint32"), "uint"),
}
_QUATERNION: Final = "geometry_msgs/Quaternion"


@dataclass(frozen=True, slots=True)
class Field:
    """A field of an interface, as a port of a block.

    Attributes:
        port: its name as a port, ``goal__pose__position__x``.
        direction: `input` or `output`.
        type: the type of the port, as in the catalogue; `any` for messages.
        ros: the type as ROS writes it.
    """

    port: str
    direction: str
    type: str
    ros: str

    @property
    def model(self) -> PortModel:
        """The port of a node."""
        path = self.port.replace(SEPARATOR, ".")
        return PortModel(self.port, self.direction, self.type, description=f"{path}, {self.ros}.")


@cache
def interface_names() -> tuple[tuple[str, str], ...]:
    """Returns the interfaces as (name, kind), sorted: ``("nav2_msgs/action/Wait", "action")``."""
    return tuple(sorted((name, name.split("/")[1]) for name in _known()))


def has_package(name: str) -> bool:
    """Returns whether the package of an interface is known here."""
    package = name.partition("/")[0]
    return any(each.startswith(f"{package}/") for each in _known())


def full_name(name: str, kind: str) -> str | None:
    """Returns the name with its kind, for ``nav2_msgs/Wait`` too; None if it is not a name of this kind."""
    match = _NAME.fullmatch(name.strip())
    if match is None or match[2] not in {None, kind}:
        return None
    return f"{match[1]}/{kind}/{match[3]}"


@cache
def interface_fields(name: str, *, is_received: bool = False) -> tuple[Field, ...] | None:
    """Returns the fields of an interface, whole messages before their own fields.

    Args:
        name: the full name.
        is_received: whether a message is received and not published; its fields are outputs then.

    Returns:
        None if the interface is not known.
    """
    if name not in _known():
        return None
    kind = name.split("/")[1]
    found: list[Field] = []
    for part, suffix in PARTS[kind]:
        direction = "output" if part in _WRITTEN or (is_received and part == "message") else "input"
        for path, ros in _walk(_fields(name, part_class(name, suffix)), 1):
            found.append(Field(SEPARATOR.join((part, *path)), direction, port_type(ros), ros))
    return tuple(found[:MOST_FIELDS])


def port_type(ros: str) -> str:
    """Returns the catalogue's name of a field's type; `any` if it has none."""
    listed = _LIST.fullmatch(ros)
    if listed is not None:
        inner = port_type(listed[1] or listed[2])
        return f"list[{inner}]" if inner in {"int", "double", "bool", "string"} else "any"
    if ros.startswith(("string", "wstring")):
        return "string"
    return _SCALARS.get(ros, "any")


def _walk(fields: Mapping[str, str], depth: int) -> Iterator[tuple[tuple[str, ...], str]]:
    for name, ros in fields.items():
        yield (name,), ros
        if "/" not in ros or "<" in ros or "[" in ros or depth == DEEPEST:
            continue
        if ros == _QUATERNION:
            yield (name, "yaw"), "double"
        package, _, short = ros.partition("/")
        for path, inner in _walk(_fields(f"{package}/msg/{short}", short), depth + 1):
            yield (name, *path), inner


@cache
def _table() -> dict[str, dict[str, dict[str, str]]]:
    """Returns the interfaces that a session has, as they were when the table was written."""
    found: dict[str, dict[str, dict[str, str]]] = json.loads(TABLE.read_bytes())
    return found


@cache
def _known() -> frozenset[str]:
    return frozenset(installed()) | frozenset(_table())


def _fields(name: str, owner: str) -> Mapping[str, str]:
    fields = installed_fields(name, owner)
    return fields if fields is not None else _table().get(name, {}).get(owner, {})
