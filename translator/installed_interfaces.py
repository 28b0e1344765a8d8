"""The interfaces of ROS that are installed here, read from their files without ROS.

The Python module of an interface holds its fields as a literal; it is parsed, never imported.
"""

from __future__ import annotations

import ast
import re
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

KINDS: Final = ("action", "msg", "srv")
PARTS: Final = {
    "action": (("goal", "Goal"), ("result", "Result"), ("feedback", "Feedback")),
    "srv": (("request", "Request"), ("response", "Response")),
    "msg": (("message", ""),),
}
"""The parts of an interface of each kind: the first word of their ports, and the end of their class."""

_IMPORT: Final = re.compile(r"^from (\w+)\.(msg|srv|action)\.(_\w+) import (\w+)\b", re.MULTILINE)


def part_class(name: str, suffix: str) -> str:
    """Returns the class of a part of an interface: ``Wait_Goal`` for ``nav2_msgs/action/Wait``."""
    short = name.rpartition("/")[2]
    return f"{short}_{suffix}" if suffix else short


def table() -> dict[str, dict[str, Mapping[str, str]]]:
    """Returns the fields of every installed interface, by the class of each part."""
    return {
        name: {
            part_class(name, suffix): installed_fields(name, part_class(name, suffix)) or {}
            for _, suffix in PARTS[name.split("/")[1]]
        }
        for name in sorted(installed())
    }


@cache
def installed() -> Mapping[str, Path]:
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
def installed_fields(name: str, owner: str) -> Mapping[str, str] | None:
    """Returns the fields of a class in the file of an interface, none if the file has another form.

    Returns:
        None if the interface is not installed.
    """
    path = installed().get(name)
    if path is None:
        return None
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
