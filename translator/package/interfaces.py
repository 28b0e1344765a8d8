"""The topics, services, actions and parameters in the README and the launch file of a package."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from translator.endpoints import Endpoint

PARAMETER = "parameter"
_WORDS = {
    "publisher": "publishes",
    "subscription": "subscribes to",
    "client": "calls the service",
    "service": "offers the service",
    "action client": "calls the action",
    "action server": "offers the action",
}
# Names that all robots of a system share by convention; a namespace does not change them.
_SHARED = frozenset({"/clock", "/diagnostics", "/parameter_events", "/rosout", "/tf", "/tf_static"})


def absolute_names(opened: Iterable[Endpoint]) -> list[str]:
    """Returns the names that begin with a slash; ROS does not put these into a namespace."""
    names = {item.name for item in opened if item.known and item.kind != PARAMETER}
    return sorted(
        name for name in names - _SHARED if name.startswith("/") and len(name) > 1 and not _has_blank(name)
    )


def interface_rows(opened: Iterable[Endpoint]) -> list[tuple[str, str, str, str]]:
    """Returns (name, type, use, user) of all names that are certain."""
    by: dict[tuple[str, str, str], set[str]] = {}
    for item in opened:
        if item.known and item.kind != PARAMETER:
            key = (item.name, item.type or "not stated in the source", _WORDS[item.kind])
            by.setdefault(key, set()).add(_who(item))
    return [
        (_cell(name), _cell(kind), verb, ", ".join(sorted(who)))
        for (name, kind, verb), who in sorted(by.items())
    ]


def example_name(opened: Sequence[Endpoint]) -> str:
    """Returns a name as an example of renaming; preferably that of an action, not of a program."""
    known = [item for item in opened if item.known and item.kind != PARAMETER and not _has_blank(item.name)]
    best = sorted(known, key=lambda item: (not item.path.startswith("actions/"), item.kind != "publisher"))
    return best[0].name if best else ""


def unknown_names(opened: Iterable[Endpoint]) -> list[str]:
    """Returns a sentence for each name that is computed while the program runs."""
    return [
        f"{item.path}, line {item.line}: {_WORDS[item.kind]} `{_cell(item.name)}`"
        + (f" of type `{item.type}`" if item.type else "")
        for item in opened
        if not item.known
    ]


def parameter_rows(opened: Iterable[Endpoint]) -> list[tuple[str, str, str]]:
    """Returns name, default and declaring action of each parameter that the package's Python declares."""
    rows = {(_cell(item.name), _cell(item.type), _who(item)) for item in opened if item.kind == PARAMETER}
    return sorted(rows)


def _who(item: Endpoint) -> str:
    return (
        PurePosixPath(item.path).name.removesuffix(".py") if item.path.startswith("actions/") else item.path
    )


def _cell(text: str) -> str:
    """Returns the text as inline code in a table's cell."""
    return " ".join(text.split()).replace("|", "\\|").replace("`", "'")


def _has_blank(text: str) -> bool:
    return any(character.isspace() for character in text)
