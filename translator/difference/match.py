"""Finds which node of one version is which of the other: by id, else by the two phases of GumTree.

Falleri et al., *Fine-grained and accurate source code differencing* (2014): first equal branches, the
highest first; then control nodes most of whose descendants are matched, and what their children have in
common. Ties are broken by the order of execution, so that both languages find the same pairs.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from typing import TYPE_CHECKING

from translator.difference.shape import ROOT, Shape, fields

if TYPE_CHECKING:
    from collections.abc import Collection, Hashable, Iterable, Mapping

LOOKED_AT = 100
"""The matched branches below a node from which partners for it are searched."""

CLIMBED = 8
"""The levels above each of them."""


def match(older: Shape, newer: Shape, *, ids: Collection[str] | None = None) -> dict[str, str]:
    """Returns the partner in `newer` of each node of `older` that has one.

    Args:
        older: The earlier version.
        newer: The later version.
        ids: Ids that mean the same node in both; without it, all of them.
    """
    pairs = {
        node_id: node_id
        for node_id in older.order
        if node_id in newer.rows and (ids is None or node_id in ids)
    }
    if len(pairs) < min(len(older.rows), len(newer.rows)):
        matching = _Matching(older, newer, pairs)
        matching.equal_branches(2)
        matching.similar_branches()
        matching.roots()
        matching.children()
        matching.equal_branches(1)
    return pairs


class _Matching:
    """One matching; `pairs` grows with each phase."""

    def __init__(self, older: Shape, newer: Shape, pairs: dict[str, str]) -> None:
        self.older = older
        self.newer = newer
        self.pairs = pairs
        self.back = {new: old for old, new in pairs.items()}
        known: dict[Hashable, int] = {}
        self.old_kinds = _Kinds(older, known)
        self.new_kinds = _Kinds(newer, known)

    def pair(self, old: str, new: str) -> None:
        if old not in self.pairs and new not in self.back:
            self.pairs[old] = new
            self.back[new] = old

    def free(self, old: Iterable[str], new: Iterable[str]) -> tuple[list[str], list[str]]:
        """Returns those that have no partner yet."""
        return [each for each in old if each not in self.pairs], [
            each for each in new if each not in self.back
        ]

    def equal_branches(self, least: int) -> None:
        """Pairs branches that are equal, with at least so many levels; the highest first.

        Leaves are paired if there is one alone on each side, since many leaves look alike.
        """
        old, new = self.free(self.older.order, self.newer.order)
        groups: dict[int, tuple[list[str], list[str]]] = defaultdict(lambda: ([], []))
        for node_id in old:
            if self.old_kinds.heights[node_id] >= least:
                groups[self.old_kinds.branches[node_id]][0].append(node_id)
        for node_id in new:
            if self.new_kinds.heights[node_id] >= least:
                groups[self.new_kinds.branches[node_id]][1].append(node_id)
        both = [group for group in groups.values() if group[0] and group[1]]
        both.sort(key=lambda group: (-self.old_kinds.heights[group[0][0]], self.older.ranks[group[0][0]]))
        for one, other in both:
            if least == 1 and (len(one) > 1 or len(other) > 1):
                continue
            for kind in ("paths", "branches"):  # those at one place first
                left = self.free(one, other)
                for a, b in _zipped(*left, getattr(self.old_kinds, kind), getattr(self.new_kinds, kind)):
                    for below, partner in zip(self.older.branch(a), self.newer.branch(b), strict=True):
                        self.pair(below, partner)

    def similar_branches(self) -> None:
        """Pairs nodes of a type of which more than half of the descendants are partners."""
        for old in reversed(self.older.order):
            if old in self.pairs or not self.older.children(old):
                continue
            branch = self.older.branch(old)
            ranks = sorted(self.newer.ranks[self.pairs[below]] for below in branch if below in self.pairs)
            if ranks and (best := self.best(old, ranks)) is not None:
                self.pair(old, best)

    def best(self, old: str, ranks: list[int]) -> str | None:
        """Returns the most similar node for `old`; `ranks` are those of its descendants' partners."""
        type_ = self.older.rows[old]["type"]
        found: dict[str, float] = {}
        for start in self.frontier(old):
            parent = self.newer.parents[self.pairs[start]]
            for _ in range(CLIMBED):
                if not parent:
                    break
                if (
                    parent not in found
                    and parent not in self.back
                    and self.newer.rows[parent]["type"] == type_
                ):
                    first = self.newer.ranks[parent]
                    size = self.newer.sizes[parent]
                    common = bisect_left(ranks, first + size) - bisect_left(ranks, first)
                    found[parent] = 2 * common / (self.older.sizes[old] + size - 2)
                parent = self.newer.parents[parent]
        good = [(-dice, self.newer.ranks[node_id], node_id) for node_id, dice in found.items() if dice > 0.5]
        return min(good)[2] if good else None

    def frontier(self, old: str) -> list[str]:
        """Returns the highest nodes below a node that have partners."""
        found: list[str] = []
        stack = list(reversed(self.older.children(old)))
        while stack and len(found) < LOOKED_AT:
            node_id = stack.pop()
            if node_id in self.pairs:
                found.append(node_id)
            else:
                stack.extend(reversed(self.older.children(node_id)))
        return found

    def roots(self) -> None:
        """Pairs the roots, if they are of one type."""
        for old, new in zip(self.older.children(ROOT), self.newer.children(ROOT), strict=False):
            if self.older.rows[old]["type"] == self.newer.rows[new]["type"]:
                self.pair(old, new)

    def children(self) -> None:
        """Pairs the children of partners: equal branches, then nodes of one name, then of one type."""
        for old in self.older.order:
            if old not in self.pairs:
                continue
            one, other = self.free(self.older.children(old), self.newer.children(self.pairs[old]))
            for kind in ("branches", "names", "types"):
                if not one or not other:
                    break
                left: Mapping[str, int] = getattr(self.old_kinds, kind)
                right: Mapping[str, int] = getattr(self.new_kinds, kind)
                for a, b in _zipped(one, other, left, right):
                    self.pair(a, b)
                one, other = self.free(one, other)


class _Kinds:
    """Numbers equal things of both versions: branches, names, types, the path of types from the root."""

    def __init__(self, shape: Shape, known: dict[Hashable, int]) -> None:
        self.branches: dict[str, int] = {}
        self.heights: dict[str, int] = {}
        self.names: dict[str, int] = {}
        self.types: dict[str, int] = {}
        self.paths: dict[str, int] = {}

        def number(*key: Hashable) -> int:
            return known.setdefault(key, len(known))

        for node_id in reversed(shape.order):
            row = shape.rows[node_id]
            children = shape.children(node_id)
            said = tuple(fields(row).items())
            self.branches[node_id] = number("branch", said, *(self.branches[child] for child in children))
            self.heights[node_id] = 1 + max((self.heights[child] for child in children), default=0)
            self.types[node_id] = number("type", row["type"])
            self.names[node_id] = number("name", row["type"], row.get("name"), row.get("tree") or "")
        for node_id in shape.order:
            parent = shape.parents[node_id]
            above = self.paths[parent] if parent else -1
            self.paths[node_id] = number("path", above, self.names[parent] if parent else -1)


def _zipped(
    old: Iterable[str], new: Iterable[str], old_kinds: Mapping[str, int], new_kinds: Mapping[str, int]
) -> list[tuple[str, str]]:
    """Returns pairs of one kind: the first with the first, the second with the second."""
    waiting: dict[int, list[str]] = defaultdict(list)
    for node_id in new:
        waiting[new_kinds[node_id]].append(node_id)
    taken: dict[int, int] = defaultdict(int)
    pairs = []
    for node_id in old:
        kind = old_kinds[node_id]
        if taken[kind] < len(waiting.get(kind, ())):
            pairs.append((node_id, waiting[kind][taken[kind]]))
            taken[kind] += 1
    return pairs
