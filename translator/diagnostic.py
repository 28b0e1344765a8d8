"""Diagnostics: a problem, its place, and a way to fix it.

Each has a code from the table in `diagnostics.json`, from which the reference page is generated, and which
the front end uses. A diagnostic always has a place: a file, and a node or a line in the file.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

TABLE_PATH = Path(__file__).with_name("diagnostics.json")


class Severity(StrEnum):
    """The severity of a diagnostic; a tree with an error does not run."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Place:
    """The place of a diagnostic: the file, and the node, port, line and column if they are known."""

    file: str = ""
    tree: str = ""
    node: str = ""
    port: str = ""
    line: int | None = None
    column: int | None = None


@dataclass(frozen=True, slots=True)
class Step:
    """A node on the path of a finding's reason.

    Attributes:
        results: the results that it can return, such as SUCCESS; empty where they do not matter.
        role: what it does there: `reads`, `writes`, `commands`; "" where it is on the way.
        what: the key or topic.
    """

    tree: str
    node: str
    label: str
    results: tuple[str, ...] = ()
    role: str = ""
    what: str = ""

    def to_json(self) -> dict[str, Any]:
        """Returns the form that the REST interface, the editor and `--json` share."""
        return {
            "tree": self.tree,
            "node": self.node,
            "label": self.label,
            "results": list(self.results),
            "role": self.role,
            "what": self.what,
        }

    def __str__(self) -> str:
        does = f"{self.role} {self.what}" if self.role else "/".join(self.results)
        return f"{self.tree}/{self.label}" + (f" ({does})" if does else "")


@dataclass(frozen=True, slots=True)
class Rule:
    """One row of the table of codes."""

    code: str
    severity: Severity
    title: str
    message: str
    hint: str


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding. `str()` returns the line that the command line prints.

    `values` are the values in message and hint; a translated text is made from the code and these values.
    `path` leads over the nodes from which the finding follows.
    """

    code: str
    severity: Severity
    message: str
    hint: str
    place: Place
    values: Mapping[str, str] = field(default_factory=dict, compare=False)
    path: tuple[Step, ...] = field(default=(), compare=False)

    @property
    def is_error(self) -> bool:
        """Whether the finding prevents the tree from running."""
        return self.severity is Severity.ERROR

    def to_json(self) -> dict[str, Any]:
        """Returns the form that the REST interface, the editor and `--json` share."""
        place = self.place
        return {
            "code": self.code,
            "severity": self.severity.value,
            "message": self.message,
            "hint": self.hint,
            "values": dict(self.values),
            "tree": place.tree,
            "node": place.node,
            "port": place.port,
            "file": place.file,
            "line": place.line,
            "column": place.column,
            "path": [step.to_json() for step in self.path],
        }

    def moved(self, **changes: Any) -> Diagnostic:
        """Returns the same finding with parts of its place replaced."""
        return replace(self, place=replace(self.place, **changes))

    def __str__(self) -> str:
        place = self.place
        where = [place.file or place.tree or "project", str(place.line or 1), str(place.column or 1)]
        inside = f" [{place.node}]" if place.node else ""
        hint = f" ({self.hint})" if self.hint else ""
        path = f" [path: {' → '.join(str(step) for step in self.path)}]" if self.path else ""
        return f"{':'.join(where)}: {self.code}{inside} {self.message}{hint}{path}"


class TranslatorError(Exception):
    """The operation failed; `diagnostics` holds the reasons, each with a place and a hint."""

    def __init__(self, diagnostics: tuple[Diagnostic, ...] | list[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(found) for found in self.diagnostics))


@cache
def rules() -> dict[str, Rule]:
    """Returns the table of codes, in its order."""
    rows = json.loads(TABLE_PATH.read_text(encoding="utf-8"))["diagnostics"]
    return {row["code"]: Rule(**{**row, "severity": Severity(row["severity"])}) for row in rows}


def diagnostic(code: str, place: Place, **values: object) -> Diagnostic:
    """Makes a diagnostic from the table, its message and hint filled with `values`."""
    rule = rules()[code]
    return Diagnostic(
        code,
        rule.severity,
        rule.message.format(**values),
        rule.hint.format(**values).strip(),
        place,
        {name: str(value) for name, value in values.items()},
    )


def errors_in(diagnostics: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Returns those of the diagnostics that are errors."""
    return tuple(found for found in diagnostics if found.is_error)
