"""Returns the change between two versions of a tree as a list of operations on nodes.

`insert`, `delete`, `wrap` (a new node around others), `unwrap` (a node taken away from around others),
`move` (another parent), `reorder` (another place among siblings), `rename`, and `change` of one field. A
node whose parent was wrapped or unwrapped did not move. The page does the same
(`frontend/src/model/difference/operations.ts`); `tests/shared/differences.json` holds both to it.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from typing import TYPE_CHECKING, Any

from translator.difference.match import match
from translator.difference.shape import Document, Parent, Shape, fields, tree_fields

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

Operation = dict[str, Any]


def compare(
    older: Document, newer: Document, *, ids: Collection[str] | None = None, layout: bool = False
) -> list[Operation]:
    """Returns the operations that make `newer` of `older`; a document and itself have none.

    Args:
        older: The earlier diagram.
        newer: The later diagram.
        ids: Ids that mean the same node in both; without it, all of them.
        layout: Whether positions, folding and the direction of the layout count.
    """
    one, other = Shape(older), Shape(newer)
    return _Comparison(one, other, match(one, other, ids=ids), layout=layout).operations()


class _Comparison:
    """Two versions and their pairs."""

    def __init__(self, older: Shape, newer: Shape, pairs: Mapping[str, str], *, layout: bool) -> None:
        self.older = older
        self.newer = newer
        self.pairs = pairs
        self.back = {new: old for old, new in pairs.items()}
        self.layout = layout
        # The nearest ancestor that both versions have, and those between that only one has.
        self.above_old = _kept_ancestors(older, pairs)
        self.above_new = _kept_ancestors(newer, self.back)
        self.moved = {new for old, new in pairs.items() if not self.stays(old, new)}
        self.reordered = self.find_reordered()

    def operations(self) -> list[Operation]:
        found = list(_changes("", tree_fields(self.older.document, layout=self.layout),
                              tree_fields(self.newer.document, layout=self.layout)))  # fmt: skip
        wrapped = self.around(self.newer, {new: new for new in self.back})
        for node_id in self.newer.order:
            old = self.back.get(node_id)
            if old is None:
                found.append(self.alone(self.newer, node_id, wrapped, "wrap", "insert"))
            else:
                found.extend(self.kept(old, node_id))
        unwrapped = self.around(self.older, self.pairs)
        found.extend(
            self.alone(self.older, node_id, unwrapped, "unwrap", "delete")
            for node_id in self.older.order
            if node_id not in self.pairs
        )
        return found

    def stays(self, old: str, new: str) -> bool:
        """Whether a node hangs where it did, apart from nodes that were put or taken between."""
        above, now = self.above_old[old], self.above_new[new]
        return self.pairs[above] == now if above else above == now

    def find_reordered(self) -> set[str]:
        """Returns the fewest nodes whose move among their siblings explains the new order."""
        groups: dict[str, list[str]] = defaultdict(list)
        for node_id in self.newer.order:
            if node_id in self.back and node_id not in self.moved and (above := self.above_new[node_id]):
                groups[above].append(node_id)
        found: set[str] = set()
        for siblings in groups.values():
            ranks = [self.older.ranks[self.back[node_id]] for node_id in siblings]
            steady = rising(ranks)
            found.update(node_id for place, node_id in enumerate(siblings) if place not in steady)
        return found

    def around(self, shape: Shape, partners: Mapping[str, str]) -> dict[str, list[str]]:
        """Returns, for each node that only one version has, the kept nodes that it is put around.

        `partners` are the kept nodes, with their ids in the newer version.
        """
        found: dict[str, list[str]] = defaultdict(list)
        for node_id in shape.order:
            new = partners.get(node_id)
            if new is None or new in self.moved:
                continue
            parent = shape.parents[node_id]
            while parent and parent not in partners:
                found[parent].append(new)
                parent = shape.parents[parent]
        return found

    def alone(
        self, shape: Shape, node_id: str, around: Mapping[str, list[str]], with_some: str, without: str
    ) -> Operation:
        """Returns the operation for a node that only one version has."""
        children = around.get(node_id)
        place = {"parent": shape.parents[node_id], "index": shape.index(node_id)}
        what = {"node": node_id, **_called(shape, node_id), **place}
        if children:
            return {"op": with_some, **what, "children": children}
        return {"op": without, **what}

    def kept(self, old: str, new: str) -> Iterator[Operation]:
        """Yields the operations on a node that both versions have."""
        before = fields(self.older.rows[old], layout=self.layout)
        after = fields(self.newer.rows[new], layout=self.layout)
        names = before.pop("name", None), after.pop("name", None)
        was = {} if old == new else {"was": old}
        if names[0] != names[1]:
            yield {"op": "rename", "node": new, **was, "before": names[0], "after": names[1]}
        for change in _changes(new, before, after):
            yield {**change, **was}
        if new in self.moved or new in self.reordered:
            yield {
                "op": "move" if new in self.moved else "reorder",
                "node": new,
                **was,
                "from": {"parent": self.older.parents[old], "index": self.older.index(old)},
                "to": {"parent": self.newer.parents[new], "index": self.newer.index(new)},
            }


def _called(shape: Shape, node_id: str) -> dict[str, str]:
    row = shape.rows[node_id]
    return {key: row[key] for key in ("type", "name", "tree") if row.get(key)}


def _kept_ancestors(shape: Shape, partners: Mapping[str, str]) -> dict[str, Parent]:
    found: dict[str, Parent] = {}
    for node_id in shape.order:
        parent = shape.parents[node_id]
        found[node_id] = found[parent] if parent and parent not in partners else parent
    return found


def _changes(node_id: str, before: Mapping[str, str], after: Mapping[str, str]) -> Iterator[Operation]:
    for field in dict.fromkeys([*before, *after]):
        one, other = before.get(field), after.get(field)
        if one != other:
            yield {"op": "change", "node": node_id, "field": field, "before": one, "after": other}


def rising(ranks: Sequence[int]) -> set[int]:
    """Returns the indices of a longest increasing subsequence of distinct numbers (patience sorting)."""
    ends: list[int] = []
    places: list[int] = []
    previous: list[int] = []
    for place, rank in enumerate(ranks):
        length = bisect_left(ends, rank)
        previous.append(places[length - 1] if length else -1)
        ends[length : length + 1] = [rank]
        places[length : length + 1] = [place]
    found: set[int] = set()
    place = places[-1] if places else -1
    while place >= 0:
        found.add(place)
        place = previous[place]
    return found
