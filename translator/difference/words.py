"""The operations between two versions in words: a line each, as `bt-studio diff` prints them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from translator.difference.projects import ChangedTree, Difference, shapes
from translator.difference.shape import ROOT, Parent, Shape

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.difference.operations import Operation

LONGEST: Final = 60
SIGNS: Final = {
    "insert": "+", "wrap": "+", "delete": "−", "unwrap": "−",
    "rename": "≠", "change": "≠", "move": "⇄", "reorder": "⇅",
}  # fmt: skip
FILE_SIGNS: Final = {"added": "+", "removed": "−", "changed": "≠"}


class Line(NamedTuple):
    """One operation: its sign, the name of the node, and a description."""

    sign: str
    who: str
    what: str


def lines(difference: Difference) -> Iterator[str]:
    """Yields the difference as lines of plain text."""
    for tree in difference.trees:
        yield heading(tree)
        if tree.change == "changed":
            for line in tree_lines(tree):
                yield f"  {line.sign} {line.who}{': ' if line.who else ''}{line.what}"
    for path, change in difference.files.items():
        yield f"{FILE_SIGNS[change]} {shown(path)} {change}"


def heading(tree: ChangedTree) -> str:
    """Returns the line about a whole tree."""
    nodes = (tree.older if tree.change == "removed" else tree.newer)["nodes"]
    extent = "" if tree.change == "changed" else f", {_count(len(nodes))}"
    return f"{FILE_SIGNS[tree.change]} tree {shown(tree.tree)} {tree.change}{extent}"


def tree_lines(tree: ChangedTree) -> Iterator[Line]:
    """Yields a line for each operation; whole branches that came or went are one."""
    older, newer = shapes(tree)
    whole = {each["node"] for each in tree.operations if each["op"] == "insert"}
    gone = {each["node"] for each in tree.operations if each["op"] == "delete"}
    for operation in tree.operations:
        inside = whole if operation["op"] == "insert" else gone if operation["op"] == "delete" else ()
        if operation.get("parent") in inside:
            continue
        shape = older if operation["op"] in {"delete", "unwrap"} else newer
        node = operation["node"]
        more = sum(below in inside for below in shape.branch(node)) - 1 if inside else 0
        below = f", with {_count(more)} below" if more > 0 else ""
        yield Line(
            SIGNS[operation["op"]],
            called(shape, node) if node else "",
            _what(operation, older, newer) + below,
        )


def _what(operation: Operation, older: Shape, newer: Shape) -> str:  # noqa: PLR0911 - one a kind
    match operation["op"]:
        case "insert":
            return f"inserted {_place(newer, operation['parent'])}"
        case "delete":
            return f"deleted {_place(older, operation['parent'], 'from')}"
        case "wrap":
            return f"put around {_names(newer, operation['children'])}"
        case "unwrap":
            return f"taken away from around {_names(newer, operation['children'])}"
        case "move":
            source, target = operation["from"]["parent"], operation["to"]["parent"]
            return f"moved {_place(older, source, 'from')} {_place(newer, target, 'to')}"
        case "reorder":
            return f"reordered from place {operation['from']['index'] + 1} to {operation['to']['index'] + 1}"
        case "rename":
            return f"renamed: {_change(operation)}"
        case _:
            return f"{shown(operation['field'].removeprefix('ports.'))}: {_change(operation)}"


def _change(operation: Operation) -> str:
    before, after = (
        "(none)" if operation[side] is None else f"“{shown(operation[side])}”" for side in ("before", "after")
    )
    return f"{before} → {after}"


def _place(shape: Shape, parent: Parent, word: str = "in") -> str:
    if parent is None:
        return f"{word} the drafts"
    return f"{word} the top of the tree" if parent == ROOT else f"{word} {called(shape, parent)}"


def _names(shape: Shape, nodes: list[str]) -> str:
    first = ", ".join(called(shape, node) for node in nodes[:3])
    return first + (f" and {len(nodes) - 3} more" if len(nodes) > 3 else "")


def _count(nodes: int) -> str:
    return f"{nodes} node{'' if nodes == 1 else 's'}"


def called(shape: Shape, node_id: str) -> str:
    """Returns how a node is called: its name or target, its type, its id."""
    row = shape.rows[node_id]
    name = row.get("name") or row.get("tree")
    type_ = f" ({shown(row['type'])})" if name else ""
    return f"{shown(name or row['type'])}{type_} [{shown(node_id)}]"


def shown(text: str) -> str:
    """Returns foreign text on one line, without characters that move the cursor of a terminal."""
    plain = "".join(char if char.isprintable() else " " for char in text)
    return plain if len(plain) <= LONGEST else f"{plain[: LONGEST - 1]}…"
