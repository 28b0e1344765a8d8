"""`enums.json`: the enumerations of a project, whose names scripts and ports can use for whole numbers."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from translator.action_ports import TYPES
from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.json_file import parse_json
from translator.limits import NAME_CHARACTERS
from translator.xml.escape import attribute

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from translator.action import ActionModel

ENUMS_FILE = "enums.json"
FORMAT = "bt-studio/enums"
VERSION = 1
LIMITS = (-(2**31), 2**31 - 1)
NAME = r"[A-Za-z_][A-Za-z0-9_]*"
_NAME = re.compile(NAME)
_TOKEN = re.compile(r'(?P<text>"(?:[^"\\]|\\.)*")(?P<colon>\s*:)?|[{}\[\]]')
_TAKEN = frozenset({*TYPES, "true", "false", "uint", "script", "status", "list"})

EnumName = Annotated[str, Field(pattern=f"^{NAME}$", max_length=NAME_CHARACTERS)]
Enumeration = dict[EnumName, Annotated[int, Field(ge=LIMITS[0], le=LIMITS[1])]]


class EnumsDocument(BaseModel):
    """The enumerations of a project, `enums.json`."""

    model_config = ConfigDict(extra="forbid", json_schema_extra={"title": ENUMS_FILE})

    format: Literal["bt-studio/enums"]
    version: Literal[1]
    enums: dict[EnumName, Enumeration] = Field(
        description="The enumerations by name, each with its numbers by name."
    )


def read_enums(raw: bytes | str) -> tuple[dict[str, dict[str, int]], tuple[Diagnostic, ...]]:
    """Reads `enums.json`; unusable entries are omitted, and reported at their lines."""
    document, problem = parse_json(raw, file=ENUMS_FILE)
    if problem is not None:
        return {}, (problem,)
    text = raw.decode("utf-8-sig") if isinstance(raw, bytes) else raw
    reader = _Reader(text)
    reader.report_repeated_keys()
    return reader.read(document), tuple(reader.found)


class _Reader:
    """Reads a parsed document, with its text for the places of findings."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.found: list[Diagnostic] = []

    def report(self, code: str, *path: str, **values: object) -> None:
        line, column = _position(self.text, path)
        self.found.append(diagnostic(code, Place(ENUMS_FILE, line=line, column=column), **values))

    def report_repeated_keys(self) -> None:
        """Reports keys that occur twice in one object: JSON keeps only the last one."""
        held: list[set[str]] = []
        for token in _TOKEN.finditer(self.text):
            if token.group() in {"{", "["}:
                held.append(set())
            elif token.group() in {"}", "]"}:
                held.pop()
            elif token.group("colon") is not None:
                key = json.loads(token.group("text"))
                if key in held[-1]:
                    line = self.text.count("\n", 0, token.start()) + 1
                    column = token.start() - self.text.rfind("\n", 0, token.start())
                    self.found.append(
                        diagnostic("BT0036", Place(ENUMS_FILE, line=line, column=column), name=key)
                    )
                held[-1].add(key)

    def read(self, document: Any) -> dict[str, dict[str, int]]:
        if not isinstance(document, dict):
            self.report("BT0004", kind=_kind(document))
            return {}
        if (found := document.get("format")) != FORMAT:
            self.report("BT0005", "format", found=found, expected=FORMAT)
            return {}
        if (version := document.get("version")) != VERSION or isinstance(version, bool):
            self.report("BT0006", "version", version=version, newest=VERSION)
            return {}
        enums = document.get("enums", {})
        if not isinstance(enums, dict):
            self.report("BT0032", "enums", name="enums")
            return {}
        owners: dict[str, tuple[str, int]] = {}
        result: dict[str, dict[str, int]] = {}
        for name, members in enums.items():
            if not _is_name(name):
                self.report("BT0033", "enums", name, name=name)
            elif not isinstance(members, dict):
                self.report("BT0032", "enums", name, name=name)
            else:
                result[name] = dict(self.members(name, members, owners))
        return result

    def members(
        self, name: str, members: dict[str, Any], owners: dict[str, tuple[str, int]]
    ) -> Iterator[tuple[str, int]]:
        for member, number in members.items():
            path = ("enums", name, member)
            if not _is_name(member):
                self.report("BT0033", *path, name=member)
            elif type(number) is not int or not LIMITS[0] <= number <= LIMITS[1]:
                shown = json.dumps(number, ensure_ascii=False)[:100]
                self.report("BT0034", *path, name=member, value=shown, low=LIMITS[0], high=LIMITS[1])
            elif (owner := owners.setdefault(member, (name, number)))[1] != number:
                other, value = owner
                self.report("BT0035", *path, name=member, enum=name, number=number, other=other, value=value)
            else:
                yield member, number


def _is_name(name: str) -> bool:
    return _NAME.fullmatch(name) is not None and len(name) <= NAME_CHARACTERS and name not in _TAKEN


def _kind(value: Any) -> str:
    return "null" if value is None else f"a {type(value).__name__}"


def _position(text: str, path: Iterable[str]) -> tuple[int, int]:
    """Returns line and column of a key, which is searched for after the key that holds it."""
    start = offset = 0
    for key in path:
        quoted = re.escape(json.dumps(key, ensure_ascii=False))
        match = re.compile(rf"{quoted}\s*:").search(text, offset)
        if match is None:
            break
        start, offset = match.start(), match.end()
    line = text.count("\n", 0, start) + 1
    return line, start - text.rfind("\n", 0, start)


def constants(enums: Mapping[str, Mapping[str, int]]) -> dict[str, int]:
    """Returns the numbers of all enumerations by name, as scripts see them."""
    return {name: number for members in enums.values() for name, number in members.items()}


def with_enums(action: ActionModel, enums: Mapping[str, Mapping[str, int]]) -> ActionModel:
    """Returns the action with the types of its ports that name an enumeration."""
    ports = tuple(
        replace(port, type=enum_type(port.named, enums[port.named])) if port.named in enums else port
        for port in action.ports
    )
    return action if ports == action.ports else replace(action, ports=ports)


def enum_type(name: str, members: Iterable[str]) -> str:
    """Returns the type of a port that takes the names of an enumeration."""
    return f"{name}[{';'.join(members)}]"


def enum_lines(enums: Mapping[str, Mapping[str, int]]) -> Iterator[str]:
    """Yields the lines of `<Enums>`, by which a self-contained document brings the enumerations."""
    if not enums:
        return
    yield "  <Enums>"
    for name, members in sorted(enums.items()):
        yield f'    <Enum name="{attribute(name)}">'
        for member, number in members.items():
            yield f'      <Value name="{attribute(member)}" value="{number}"/>'
        yield "    </Enum>"
    yield "  </Enums>"


def enums_text(enums: Mapping[str, Mapping[str, int | str]]) -> str:
    """Returns the text of `enums.json`."""
    document = {"format": FORMAT, "version": VERSION, "enums": enums}
    return json.dumps(document, ensure_ascii=False, indent=2) + "\n"
