"""The interfaces of ROS that are installed here: names and fields, read from their files without ROS.

The Python module of an interface holds its fields as a literal; it is parsed, never imported.
"""

from __future__ import annotations

import ast
import re
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from translator.catalog import PortModel

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

KINDS: Final = ("action", "msg", "srv")
SEPARATOR: Final = "__"
MOST_FIELDS: Final = 600
DEEPEST: Final = 8

_NAME: Final = re.compile(r"([a-z]\w*)/(?:(msg|srv|action)/)?([A-Z]\w*)")
_IMPORT: Final = re.compile(r"^from (\w+)\.(msg|srv|action)\.(_\w+) import (\w+)\b", re.MULTILINE)
_LIST: Final = re.compile(r"sequence<(.+?)(?:, \d+)?>|(.+)\[\d+\]")
_PARTS: Final = {
    "action": (("goal", "Goal"), ("result", "Result"), ("feedback", "Feedback")),
    "srv": (("request", "Request"), ("response", "Response")),
    "msg": (("message", ""),),
}
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
    """Returns the installed interfaces as (name, kind), sorted: ``("nav2_msgs/action/Wait", "action")``."""
    return tuple(sorted((name, name.split("/")[1]) for name in _modules()))


def has_package(name: str) -> bool:
    """Returns whether the package of an interface is installed here."""
    package = name.partition("/")[0]
    return any(each.startswith(f"{package}/") for each in _modules())


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
        None if the interface is not installed.
    """
    if name not in _modules():
        return None
    _, kind, short = name.split("/")
    found: list[Field] = []
    for part, suffix in _PARTS[kind]:
        direction = "output" if part in _WRITTEN or (is_received and part == "message") else "input"
        owner = f"{short}_{suffix}" if suffix else short
        for path, ros in _walk(_fields(name, owner), 1):
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
def _modules() -> Mapping[str, Path]:
    """Returns the Python file of each installed interface."""
    found: dict[str, Path] = {}
    for root in dict.fromkeys(sys.path):
        for kind in KINDS:
            for index in sorted(Path(root or ".").glob(f"*/{kind}/__init__.py")):
                for package, its_kind, module, short in _IMPORT.findall(_text(index)):
                    if its_kind == kind and "_" not in short and package == index.parts[-3]:
                        found.setdefault(f"{package}/{kind}/{short}", index.with_name(f"{module}.py"))
    return found


@cache
def _fields(name: str, owner: str) -> Mapping[str, str]:
    """Returns the fields of a class in the file of an interface; none if the file has another form."""
    path = _modules().get(name)
    if path is None:
        return {}
    try:
        module = ast.parse(_text(path))
        for node in module.body:
            if isinstance(node, ast.ClassDef) and node.name == owner:
                return _literal(node)
    except (SyntaxError, ValueError):
        return {}
    return {}


def _literal(owner: ast.ClassDef) -> Mapping[str, str]:
    for statement in owner.body:
        if (
            isinstance(statement, ast.Assign)
            and ast.unparse(statement.targets[0]) == "_fields_and_field_types"
        ):
            fields: dict[str, str] = ast.literal_eval(statement.value)
            return {
                key: value for key, value in fields.items() if key != "structure_needs_at_least_one_member"
            }
    return {}


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return ""
