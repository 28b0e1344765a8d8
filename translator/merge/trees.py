"""Merges two versions of a tree three ways, by nodes: fields, parents, order, added and removed nodes.

Where both sides changed the same thing differently, our side stays and a conflict says what they have. A node
that one side deleted and the other changed stays in the tree until somebody has decided, with what is below
it: so nothing is lost before. Layout never conflicts.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from translator.catalog import builtins
from translator.diagram import needed_version
from translator.difference.shape import ROOT, Document, Parent, Row, Shape, fields
from translator.merge.order import merge_order
from translator.merge.rows import choose, merge_values

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

Conflict = dict[str, Any]
"""`op`, `node` (empty for the tree itself), perhaps `field`, and `base`, `ours`, `theirs`."""


@dataclass(frozen=True, slots=True)
class Merged:
    """The result: a diagram, with its conflicts in the key `conflicts` if there are any."""

    document: dict[str, Any]
    conflicts: tuple[Conflict, ...]


def merge_documents(base: Document, ours: Document, theirs: Document) -> Merged:
    """Returns the merge of two diagrams whose ids mean the same nodes."""
    return _Merge(Shape(base), Shape(ours), Shape(theirs)).merged()


class _Merge:
    """One merge, in this order: the set of nodes, their parents, their order, their fields."""

    def __init__(self, base: Shape, ours: Shape, theirs: Shape) -> None:
        self.base = base
        self.ours = ours
        self.theirs = _with_own_ids(base, ours, theirs)
        self.conflicts: list[Conflict] = []
        self.parents: dict[str, Parent] = {}

    def merged(self) -> Merged:
        for node in dict.fromkeys([*self.ours.order, *self.theirs.order]):
            if self.is_alive(node):
                self.parents[node] = self.parent(node)
        while self.hold_parents() or self.break_ring():
            pass
        self.keep_one_root()
        children = self.ordered()
        rows = {node: self.row(node, children.get(node, [])) for node in self.parents}
        document = self.top()
        document["root"] = next(iter(children.get(ROOT, ())), None)
        document["nodes"] = rows
        document["drafts"] = children.get(None, [])
        document["nodes"] = {node: rows[node] for node in Shape(document).order}
        if "version" in document:
            document["version"] = needed_version(rows.values(), self.ours.document["version"])
        self.check_counts(document)
        earlier = [each for side in (self.ours, self.theirs) for each in side.document.get("conflicts", ())]
        conflicts = [each for at, each in enumerate([*earlier, *self.conflicts]) if each not in earlier[:at]]
        if conflicts:
            document["conflicts"] = conflicts
        return Merged(document, tuple(conflicts))

    def report(self, op: str, node: str, sides: Iterable[Any], **more: Any) -> None:
        base, ours, theirs = sides
        self.conflicts.append({"op": op, "node": node, **more, "base": base, "ours": ours, "theirs": theirs})

    # Which nodes there are.

    def is_alive(self, node: str) -> bool:
        """Whether a node is in the result; a conflict where one side deleted it and the other changed it."""
        if node not in self.base.rows or (node in self.ours.rows and node in self.theirs.rows):
            return True
        kept = self.ours if node in self.ours.rows else self.theirs
        if not self.is_touched(kept, node):
            return False
        self.report_deletion(node)
        return True

    def is_touched(self, side: Shape, node: str) -> bool:
        """Whether a side changed a node, its parent, or the order of its children."""
        if fields(side.rows[node]) != fields(self.base.rows[node]):
            return True
        if side.parents[node] != self.base.parents[node]:
            return True
        before, now = self.base.children(node), side.children(node)
        return [each for each in now if each in before] != [each for each in before if each in now]

    def report_deletion(self, node: str) -> None:
        rows = (side.rows.get(node) for side in (self.base, self.ours, self.theirs))
        self.report("delete", node, (dict(row) if row is not None else None for row in rows))

    # Where they are.

    def parent(self, node: str) -> Parent:
        """Returns the parent of a node; different moves of both sides are a conflict."""
        if node not in self.theirs.rows:
            return self.ours.parents[node]
        if node not in self.ours.rows or node not in self.base.rows:
            return self.theirs.parents[node]
        sides = (self.base.parents[node], self.ours.parents[node], self.theirs.parents[node])
        found: Parent = choose(sides, lambda _: self.report("move", node, self.places(node)))
        return found

    def places(self, node: str) -> Iterator[dict[str, Any] | None]:
        for side in (self.base, self.ours, self.theirs):
            if node in side.rows:
                yield {"parent": side.parents[node], "index": side.index(node)}
            else:
                yield None

    def hold_parents(self) -> bool:
        """Keeps deleted nodes into which the other side put something; returns whether there was one."""
        missing = dict.fromkeys(
            parent for parent in self.parents.values() if parent and parent not in self.parents
        )
        for node in missing:
            kept = self.ours if node in self.ours.rows else self.theirs
            self.parents[node] = kept.parents[node]
            self.report_deletion(node)
        return bool(missing)

    def break_ring(self) -> bool:
        """Takes their moves back where moves of both sides make a ring; returns whether there was one."""
        clear: set[str] = set()
        for start in self.parents:
            trail: dict[str, None] = {}
            node: Parent = start
            while node and node not in clear and node in self.parents and node not in trail:
                trail[node] = None
                node = self.parents[node]
            if node and node in trail:
                ring = list(trail)[list(trail).index(node) :]
                for each in ring:
                    if each in self.ours.rows and self.parents[each] != self.ours.parents[each]:
                        self.report("ring", each, self.places(each), ring=ring)
                        self.parents[each] = self.ours.parents[each]
                return True
            clear.update(trail)
        return False

    def keep_one_root(self) -> None:
        """Makes drafts of all roots but one, ours if there is one."""
        roots = [node for node, parent in self.parents.items() if parent == ROOT]
        if len(roots) <= 1:
            return
        sides = (self.base, self.ours, self.theirs)
        own = self.ours.document.get("root")
        kept = own if own in roots else roots[0]
        for node in roots:
            if node != kept:
                self.parents[node] = None
                self.report("root", node, (side.document.get("root") for side in sides))

    # In which order.

    def ordered(self) -> dict[Parent, list[str]]:
        members: dict[Parent, dict[str, None]] = {}
        for node, parent in self.parents.items():
            members.setdefault(parent, {})[node] = None
        return {parent: self.order(parent, list(inside)) for parent, inside in members.items()}

    def order(self, parent: Parent, members: list[str]) -> list[str]:
        inside = set(members)
        base, ours, theirs = (
            self.siblings(side, parent, inside) for side in (self.base, self.ours, self.theirs)
        )
        found, is_conflict = merge_order((base, ours, theirs), members)
        if is_conflict and parent:
            self.report("reorder", parent, (base, ours, theirs))
        return found

    def siblings(self, side: Shape, parent: Parent, members: set[str]) -> list[str]:
        """Returns the members in a side's order.

        A node that the other side put around some stands where they are, and the children of one that it took
        away stand where that was.
        """
        if parent and parent not in side.rows:
            return []
        found: dict[str, None] = {}
        stack = list(reversed(side.children(parent)))
        while stack:
            node = stack.pop()
            if node not in self.parents:
                stack.extend(reversed(side.children(node)))
                continue
            top: Parent = node
            while top and top not in members:
                top = self.parents.get(top)
            if top and (top == node or top not in side.rows):
                found[top] = None
        return list(found)

    # What they say.

    def row(self, node: str, children: list[str]) -> dict[str, Any]:
        ours, theirs = self.ours.rows.get(node), self.theirs.rows.get(node)
        if ours is None or theirs is None:
            only: Row = ours if ours is not None else theirs or {}
            row = {key: value for key, value in only.items() if key != "children"}
        else:
            row = merge_values(
                self.base.rows.get(node, {}),
                ours,
                theirs,
                lambda field, sides: self.report(
                    "rename" if field == "name" else "change", node, sides, field=field
                ),
            )
        return {**row, "children": children} if children else row

    def top(self) -> dict[str, Any]:
        """Returns the values of the tree itself."""
        ours = self.ours.document
        found = merge_values(
            self.base.document,
            ours,
            self.theirs.document,
            lambda field, sides: self.report("change", "", sides, field=field),
        )
        head = {key: ours[key] for key in ("format", "version") if key in ours}
        return {**head, **found}

    def check_counts(self, document: Document) -> None:
        """Reports nodes with a number of children that they cannot have, though they can on both sides."""
        shape = Shape(document)
        for node, row in shape.rows.items():
            if (model := builtins().get(row["type"])) is None:
                continue
            least, most = model.min_children, model.max_children

            def fits(side: Shape, node: str = node, least: int = least, most: int | None = most) -> bool:
                count = len(side.children(node))
                return least <= count and (most is None or count <= most)

            sides = [side for side in (self.ours, self.theirs) if node in side.rows]
            if not fits(shape) and all(fits(side) for side in sides):
                lists = (
                    list(side.children(node)) if node in side.rows else None
                    for side in (self.base, self.ours, self.theirs)
                )
                self.report("children", node, lists)


def _with_own_ids(base: Shape, ours: Shape, theirs: Shape) -> Shape:
    """Returns their side with new ids for the nodes that they made under an id of another node of ours."""
    names: dict[str, str] = {}
    for node in theirs.order:
        if node in base.rows or node not in ours.rows:
            continue
        parent = theirs.parents[node]
        one, other = ours.rows[node], theirs.rows[node]
        is_same = one["type"] == other["type"] and (one.get("name") == other.get("name") or not base.rows)
        if not is_same or ours.parents[node] != parent or parent in names:
            number = 2
            while any(f"{node}_{number}" in side.rows for side in (base, ours, theirs)):
                number += 1
            names[node] = f"{node}_{number}"
    return Shape(renamed(theirs.document, names)) if names else theirs


def renamed(document: Document, names: dict[str, str]) -> Document:
    """Returns a diagram with other ids for some of its nodes."""
    nodes = {
        names.get(node, node): {**row, "children": [names.get(child, child) for child in row["children"]]}
        if row.get("children")
        else row
        for node, row in document["nodes"].items()
    }
    root = document.get("root")
    drafts = [names.get(draft, draft) for draft in document.get("drafts", ())]
    return {**document, "root": names.get(root, root) if root else root, "nodes": nodes, "drafts": drafts}
