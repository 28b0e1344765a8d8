"""Gives the nodes of three versions without ids of their own the ids of our version."""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.difference.match import match
from translator.difference.shape import Document, Shape, fields
from translator.merge.trees import renamed

if TYPE_CHECKING:
    from collections.abc import Collection


def align(
    base: Document, ours: Document, theirs: Document, ids: Collection[str]
) -> tuple[Document, Document]:
    """Returns base and theirs, in which a node has the id of its partner in ours.

    Args:
        base: The common version.
        ours: Our version; its ids do not change.
        theirs: Their version.
        ids: Ids that mean the same node in all three.
    """
    old, mine, other = Shape(base), Shape(ours), Shape(theirs)
    to_ours, to_theirs = match(old, mine, ids=ids), match(old, other, ids=ids)
    taken = {*mine.rows}

    def fresh(node: str) -> str:
        number = 2
        while f"{node}_{number}" in taken:
            number += 1
        taken.add(f"{node}_{number}")
        return f"{node}_{number}"

    base_names = {node: to_ours[node] if node in to_ours else fresh(node) for node in old.order}
    from_theirs = {there: node for node, there in to_theirs.items()}
    new = [node for node in mine.order if node not in set(to_ours.values())]
    their_names: dict[str, str] = {}
    for node in other.order:
        if node in from_theirs:
            their_names[node] = base_names[from_theirs[node]]
            continue
        # The same insertion on both sides is one.
        parent = other.parents[node]
        above = their_names[parent] if parent else parent
        said = fields(other.rows[node])
        twin = next(
            (each for each in new if mine.parents[each] == above and fields(mine.rows[each]) == said), None
        )
        if twin is None:
            their_names[node] = fresh(node) if node in taken else node
            taken.add(their_names[node])
        else:
            new.remove(twin)
            their_names[node] = twin
    return renamed(base, base_names), renamed(theirs, their_names)
