"""Finds the blocks of a tree that are conditions, by the classes of the project's own actions.

A list of projects draws each tree. It reads the one line of the class that it needs, since a full reading of
every action of every project would take too long.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

_SAYS: Final = re.compile(rb"""^[ \t]+NODE_KIND\b[^=\n]*=\s*["'](\w+)["']""", re.MULTILINE)
_NAME: Final = re.compile(r"[A-Za-z_]\w{0,99}")


def action_paths(diagram: dict[str, Any] | None) -> dict[str, str]:
    """Returns the file in which a project would define each type of the tree, by type."""
    nodes = (diagram or {}).get("nodes")
    found = nodes.values() if isinstance(nodes, dict) else ()
    types = {str(node.get("type", "")) for node in found if isinstance(node, dict)}
    return {name: f"actions/{name}.py" for name in sorted(types) if _NAME.fullmatch(name)}


def conditions(diagram: dict[str, Any] | None, source: Callable[[str], bytes | None]) -> list[str]:
    """Returns the types of the tree that are conditions; `source` reads a file of the project."""
    paths = action_paths(diagram)
    return [name for name, path in paths.items() if _SAYS.findall(source(path) or b"")[-1:] == [b"Condition"]]


def all_paths(diagrams: Iterable[dict[str, Any]]) -> set[str]:
    """Returns the files that `conditions` would read for these trees."""
    return {path for diagram in diagrams for path in action_paths(diagram).values()}
