"""Merges single values: those of a node, and those of a tree that are not its nodes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final

from translator.difference.shape import LAYOUT, MAPS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    Values = Mapping[str, Any]
    Sides = tuple[Any, Any, Any]
    Report = Callable[[str, Sides], None]

LINKS: Final = frozenset({"children", "nodes", "root", "drafts", "format", "version", "conflicts"})
QUIET: Final = frozenset({*LAYOUT, "layout"})
"""Layout is no change: where both sides changed it, ours stays."""


def merge_values(base: Values, ours: Values, theirs: Values, report: Report) -> dict[str, Any]:
    """Returns the merged values of a node or tree, except its links; reports fields that conflict."""
    merged: dict[str, Any] = {}
    for key in dict.fromkeys([*ours, *theirs]):
        if key in LINKS:
            continue
        sides = base.get(key), ours.get(key), theirs.get(key)
        if key in MAPS and all(_is_map(side) for side in sides):
            value: Any = _merge_map(key, sides, report)
        elif key == "ports" and all(_is_rows(side) for side in sides):
            value = _merge_ports(sides, report)
        else:
            value = choose(sides, _quiet if key in QUIET else partial(report, key))
        if value is not None and value not in ({}, []):
            merged[key] = value
    return merged


def choose(sides: Sides, conflict: Callable[[Sides], None]) -> Any:
    """Returns the value that one side changed; ours, and calls `conflict`, if both changed it differently.

    Args:
        sides: The value in the common version, in ours and in theirs.
        conflict: Called with the sides.
    """
    base, ours, theirs = sides
    if theirs in (base, ours):
        return ours
    if ours == base:
        return theirs
    conflict(sides)
    return ours


def _quiet(sides: Sides) -> None:
    """Reports nothing."""


def _merge_map(part: str, sides: Sides, report: Report) -> dict[str, Any]:
    base, ours, theirs = (side or {} for side in sides)
    found = {}
    for key in dict.fromkeys([*ours, *theirs]):
        values = base.get(key), ours.get(key), theirs.get(key)
        value = choose(values, partial(report, f"{part}.{key}"))
        if value is not None:
            found[key] = value
    return found


def _merge_ports(sides: Sides, report: Report) -> list[Any]:
    base, ours, theirs = ({row["name"]: row for row in side or ()} for side in sides)
    return list(_merge_map("ports", (base, ours, theirs), report).values())


def _is_map(value: Any) -> bool:
    return value is None or isinstance(value, dict)


def _is_rows(value: Any) -> bool:
    return value is None or (
        isinstance(value, list) and all(isinstance(row, dict) and "name" in row for row in value)
    )
