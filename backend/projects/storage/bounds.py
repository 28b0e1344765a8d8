"""Limits of the trees of a project. A project that already exceeds a limit may shrink but must not grow.

Parsing diagrams at each save would be slow. So nodes are counted exactly only if two estimates permit too
many nodes: the size in bytes, and the number of braces, of which each node has one however it is written.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from backend.core.limits import LIMITS
from backend.projects.errors import QuotaExceededError
from backend.projects.storage import cache, names

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from backend.projects.storage.changes import Existing, Plan, Source

NODE_BYTES: Final = len('"n":{"type":"A"}')
"""The smallest size of a node in bytes."""
MARK: Final = b"{"


class _Tree(NamedTuple):
    path: str
    sha256: str
    size: int


def require_bounded(current: Mapping[str, Existing], result: Plan) -> None:
    """Raises QuotaExceededError if a change makes trees grow beyond the limits."""
    changed = {written.path for written in result.written} | set(result.removed)
    if not any(_is_diagram(path) for path in changed):
        return
    before = [_Tree(e.path, e.sha256, e.size) for e in current.values() if _is_diagram(e.path)]
    staying = [tree for tree in before if tree.path not in changed]
    after = staying + [_Tree(w.path, w.sha256, w.size) for w in result.written if _is_diagram(w.path)]
    _require(len(after), len(before), "trees_per_project", "trees")
    size, old_size = (sum(tree.size for tree in trees) for trees in (after, before))
    _require(size, old_size, "diagram_bytes_per_project", "bytes of trees")
    contents = _Contents({w.sha256: w.content for w in result.written if w.content is not None})
    _require_nodes(before, after, contents)


def _require_nodes(before: list[_Tree], after: list[_Tree], contents: _Contents) -> None:
    olds = {tree.path: tree for tree in before}
    most = LIMITS["nodes_per_tree"]
    for tree in after:
        old = olds.get(tree.path)
        if (old is None or old.sha256 != tree.sha256) and contents.may_exceed([tree], most):
            what = f"nodes in “{names.shown(tree.path)}”"
            _require(contents.nodes([tree]), contents.nodes([old] if old else []), "nodes_per_tree", what)
    if contents.may_exceed(after, LIMITS["nodes_per_project"]):
        _require(contents.nodes(after), contents.nodes(before), "nodes_per_project", "nodes")


def _require(number: int, before: int, limit: str, what: str) -> None:
    most = LIMITS[limit]
    if number > most and number > before:
        raise QuotaExceededError(
            f"A project has at most {most:,} {what}; these would be {number:,}.",
            hint="Split it into several projects, or remove trees that are not used.",
            field="files",
        )


class _Contents:
    """The bytes of diagrams, and their numbers of nodes."""

    def __init__(self, written: Mapping[str, Source]) -> None:
        self._written = written
        self._nodes: dict[str, int] = {}

    def may_exceed(self, trees: Sequence[_Tree], most: int) -> bool:
        """Returns whether the trees could have more than `most` nodes, by an estimate without parsing."""
        if sum(tree.size for tree in trees) <= most * NODE_BYTES:
            return False
        return sum(self._data(tree).count(MARK) for tree in trees) > most

    def nodes(self, trees: Sequence[_Tree]) -> int:
        """Returns the number of nodes of the trees."""
        return sum(self._count(tree) for tree in trees)

    def _count(self, tree: _Tree) -> int:
        if tree.sha256 not in self._nodes:
            self._nodes[tree.sha256] = _nodes(self._data(tree))
        return self._nodes[tree.sha256]

    def _data(self, tree: _Tree) -> bytes:
        written = self._written.get(tree.sha256)
        return cache.contents([tree.sha256])[tree.sha256] if written is None else written.data


def _nodes(data: bytes) -> int:
    """Returns the number of nodes of a diagram; 0 for a file that the translator cannot read."""
    try:
        document: Any = json.loads(data)
    except (ValueError, RecursionError):
        return 0
    nodes = document.get("nodes") if isinstance(document, dict) else None
    return len(nodes) if isinstance(nodes, dict) else 0


def _is_diagram(path: str) -> bool:
    return path.startswith("trees/") and path.endswith(".json")
