"""Message definitions: ours from `msg/`, those of ROS from the folders of its packages.

A recording holds the definition of each of its types, with those of all types that it uses, in the encoding
`ros2msg`. So every reader decodes it, with no package installed. Our definitions are never changed, only
added to.
"""

from __future__ import annotations

import functools
import os
import re
import sys
from pathlib import Path
from typing import Final, NamedTuple

__all__ = ["OURS", "DefinitionError", "Field", "fields_of", "full_text", "names_of_ours"]

OURS: Final = "bt_studio_msgs"
FOLDER: Final = Path(__file__).with_name("msg")
BUILT: Final = Path(__file__).parents[1] / "ros" / "interfaces"
PRIMITIVES: Final = frozenset(
    ("bool", "byte", "char", "float32", "float64", "int8", "uint8", "int16", "uint16", "int32", "uint32")
) | {"int64", "uint64", "string", "wstring"}
_SEPARATOR: Final = "=" * 80
_LINE: Final = re.compile(
    r"^([A-Za-z]\w*(?:/\w+){0,2})(<=\d+)?(\[(?:<=)?\d*\])?\s+([a-zA-Z]\w*)(\s*=.*|\s.*)?$"
)


class DefinitionError(Exception):
    """The definition of a type does not exist."""


class Field(NamedTuple):
    """One field of a message; `kind` is a primitive or `package/Name`, `length` that of a fixed list."""

    name: str
    kind: str
    is_list: bool
    length: int = 0


def names_of_ours() -> list[str]:
    """Returns our types, as `bt_studio_msgs/msg/Tick`."""
    return sorted(f"{OURS}/msg/{path.stem}" for path in FOLDER.glob("*.msg"))


@functools.cache
def fields_of(name: str) -> tuple[Field, ...]:
    """Returns the fields of a type; constants are left out.

    Raises:
        DefinitionError: there is no such type.
    """
    package = name.split("/", maxsplit=1)[0]
    found = []
    for raw in _text(name).splitlines():
        match = _LINE.match(raw.split("#", maxsplit=1)[0].strip())
        if match is not None and not (match[5] or "").strip().startswith("="):
            kind = match[1]
            if kind not in PRIMITIVES:
                kind = _short(kind if "/" in kind else f"{package}/{kind}")
            digits = (match[3] or "").strip("[]")
            length = int(digits) if digits.isdigit() else 0
            found.append(Field(match[4], kind, match[3] is not None, length))
    return tuple(found)


@functools.cache
def full_text(name: str) -> str:
    """Returns the definition of a type, followed by those of all types that it uses.

    Raises:
        DefinitionError: one of them does not exist.
    """
    parts, seen, open_ = [_text(name)], {_short(name)}, [name]
    while open_:
        for field in fields_of(open_.pop(0)):
            if field.kind not in PRIMITIVES and field.kind not in seen:
                seen.add(field.kind)
                open_.append(field.kind)
                parts.append(f"{_SEPARATOR}\nMSG: {field.kind}\n{_text(field.kind)}")
    return "\n".join(parts)


def _short(name: str) -> str:
    package, *_, message = name.split("/")
    return f"{package}/{message}"


def _text(name: str) -> str:
    package, message = _short(name).split("/")
    if not re.fullmatch(r"\w+/\w+", f"{package}/{message}"):
        raise DefinitionError(f"{name!r} is not the name of a message type")
    if package == OURS:
        path = FOLDER / f"{message}.msg"
        if path.is_file():
            return path.read_text(encoding="utf-8")
    for prefix in _prefixes():
        path = prefix / "share" / package / "msg" / f"{message}.msg"
        if path.is_file():
            return path.read_text(encoding="utf-8")
    if (text := _of_our_build(package, message)) is not None:
        return text
    raise DefinitionError(f"the definition of {name} is not there")


def _of_our_build(package: str, message: str) -> str | None:
    """Returns a definition of the packages without a wheel, which set-up builds from one file each."""
    path = BUILT / f"{package}.txt"
    if not path.is_file():
        return None
    _, mark, rest = f"\n{path.read_text(encoding='utf-8')}".partition(f"\n[msg/{message}]\n")
    return re.split(r"\n\[(?:msg|srv|action)/", rest)[0] + "\n" if mark else None


@functools.cache
def _prefixes() -> tuple[Path, ...]:
    """Returns the folders in which ROS packages are: those of ROS, and that of our wheels."""
    named = [Path(text) for text in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if text]
    return (*named, Path(sys.prefix))
