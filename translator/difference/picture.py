"""Both versions of a tree in one SVG: changed blocks are marked, branches without a change are folded."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING, Final

from translator.difference.projects import ChangedTree, shapes
from translator.difference.shape import ROOT, Shape
from translator.difference.words import SIGNS, called, heading, shown

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from translator.difference.operations import Operation

WIDTH: Final = 190
HEIGHT: Final = 46
LINE: Final = 16
GAP_X: Final = 22
GAP_Y: Final = 40
MARGIN: Final = 24
MOST_LINES: Final = 4
CHARACTERS: Final = 26

COLORS: Final = {
    "+": "#1a7f37",
    "−": "#cf222e",
    "≠": "#9a6700",
    "⇄": "#0969da",
    "⇅": "#0969da",
    "": "#57606a",
}
FONT: Final = "system-ui, 'Segoe UI', sans-serif"


@dataclass(slots=True)
class _Block:
    """A block of the picture."""

    title: str
    kind: str
    sign: str = ""
    notes: list[str] = field(default_factory=list)
    tooltip: str = ""
    children: list[str] = field(default_factory=list)
    x: float = 0.0
    y: float = 0.0

    @property
    def height(self) -> float:
        return HEIGHT + LINE * len(self.notes)


def picture(trees: Sequence[ChangedTree]) -> str:
    """Returns an SVG with the trees below each other; foreign text is escaped."""
    parts: list[str] = []
    y, width = float(MARGIN), 300.0
    for tree in trees:
        parts.append(_text(MARGIN, y + 16, heading(tree), size=16, weight=700))
        blocks, tops = _blocks(tree)
        right, bottom = _place(blocks, tops, y + 36)
        parts.extend(_drawn(blocks))
        y, width = bottom + MARGIN, max(width, right + MARGIN)
    if not trees:
        parts.append(_text(MARGIN, y + 16, "No tree differs.", size=16))
        y += 40
    size = f'width="{width:.0f}" height="{y:.0f}" viewBox="0 0 {width:.0f} {y:.0f}"'
    background = f'<rect width="{width:.0f}" height="{y:.0f}" fill="#ffffff"/>'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="{FONT}" role="img">'
    return "\n".join([head, background, *parts, "</svg>"]) + "\n"


def _blocks(tree: ChangedTree) -> tuple[dict[str, _Block], list[str]]:
    """Returns the blocks by key, and those at the top; removed blocks stand at their old places."""
    older, newer = shapes(tree)
    by_node: dict[tuple[bool, str], list[Operation]] = defaultdict(list)
    for operation in tree.operations:
        by_node[operation["op"] in {"delete", "unwrap"}, operation["node"]].append(operation)
    gone = {node for is_gone, node in by_node if is_gone}
    names = {old: old for old in older.rows.keys() & newer.rows.keys() if old not in gone}
    names.update((each["was"], each["node"]) for each in tree.operations if "was" in each)
    blocks = {f"new {node}": _block(newer, node, by_node[False, node]) for node in newer.order}
    blocks.update(
        (f"old {node}", _block(older, node, by_node[True, node])) for node in older.order if node in gone
    )
    for node in newer.order:
        blocks[f"new {node}"].children = [f"new {child}" for child in newer.children(node)]
    tops = [f"new {node}" for node in (*newer.children(ROOT), *newer.children(None))]
    for node in older.order:
        if node not in gone:
            continue
        parent = older.parents[node]
        host = f"old {parent}" if parent in gone else f"new {names[parent]}" if parent in names else ""
        siblings = blocks[host].children if host in blocks else tops
        siblings.insert(min(older.index(node), len(siblings)), f"old {node}")
    _fold(blocks, tops)
    return blocks, tops


def _block(shape: Shape, node: str, operations: list[Operation]) -> _Block:
    row = shape.rows[node]
    title = row.get("name") or row.get("tree") or row["type"]
    block = _Block(
        _cut(title), _cut(row["type"]) if title != row["type"] else "", tooltip=called(shape, node)
    )
    signs = [SIGNS[each["op"]] for each in operations]
    block.sign = next((sign for sign in ("+", "−", "≠", "⇄", "⇅") if sign in signs), "")
    for each in operations:
        if each["op"] in {"change", "rename"}:
            name = each.get("field", "name").removeprefix("ports.")
            before, after = (each[side] if each[side] is not None else "∅" for side in ("before", "after"))
            block.notes.append(_cut(f"{name}: {before} → {after}"))
        elif each["op"] in {"move", "reorder", "wrap", "unwrap"}:
            words = {"move": "moved", "reorder": "reordered", "wrap": "around others", "unwrap": "unwrapped"}
            block.notes.append(words[each["op"]])
    if len(block.notes) > MOST_LINES:
        block.notes[MOST_LINES - 1 :] = [f"and {len(block.notes) - MOST_LINES + 1} more"]
    return block


def _fold(blocks: dict[str, _Block], tops: list[str]) -> None:
    """Omits the descendants of blocks without a change in their branch."""
    order: list[str] = []
    stack = list(tops)
    while stack:
        key = stack.pop()
        order.append(key)
        stack.extend(blocks[key].children)
    sizes: dict[str, int] = {}
    touched: set[str] = set()
    for key in reversed(order):
        block = blocks[key]
        sizes[key] = 1 + sum(sizes[child] for child in block.children)
        if block.sign or any(child in touched for child in block.children):
            touched.add(key)
    for key in order:
        if key not in touched and blocks[key].children:
            blocks[key].notes = [f"… {sizes[key] - 1} below, equal"]
            blocks[key].children = []
    kept: set[str] = set()
    stack = list(tops)
    while stack:
        key = stack.pop()
        kept.add(key)
        stack.extend(blocks[key].children)
    for key in blocks.keys() - kept:
        del blocks[key]


def _place(blocks: dict[str, _Block], tops: list[str], top: float) -> tuple[float, float]:
    """Places leaves beside each other and parents above their children; returns the right and lower end."""
    order: list[tuple[str, int]] = []
    stack = [(key, 0) for key in reversed(tops)]
    while stack:
        key, level = stack.pop()
        order.append((key, level))
        stack.extend((child, level + 1) for child in reversed(blocks[key].children))
    heights: dict[int, float] = defaultdict(float)
    for key, level in order:
        heights[level] = max(heights[level], blocks[key].height)
    starts, y = {}, top
    for level in sorted(heights):
        starts[level] = y
        y += heights[level] + GAP_Y
    x = float(MARGIN)
    for key, level in order:
        blocks[key].y = starts[level]
        if not blocks[key].children:
            blocks[key].x = x
            x += WIDTH + GAP_X
    for key, _ in reversed(order):
        if children := blocks[key].children:
            blocks[key].x = (blocks[children[0]].x + blocks[children[-1]].x) / 2
    return x - GAP_X, (y - GAP_Y if order else y)


def _drawn(blocks: dict[str, _Block]) -> Iterator[str]:
    for block in blocks.values():
        for child in (blocks[key] for key in block.children):
            middle = child.y - GAP_Y / 2
            start = f"M{block.x + WIDTH / 2:g} {block.y + block.height:g}"
            path = f"{start}V{middle:g}H{child.x + WIDTH / 2:g}V{child.y:g}"
            yield f'<path d="{path}" fill="none" stroke="#8c959f" stroke-width="1.5"/>'
    for block in blocks.values():
        color = COLORS[block.sign]
        dash = ' stroke-dasharray="6 4"' if block.sign == "−" else ""
        yield "<g>"
        yield f"<title>{escape(block.tooltip)}</title>"
        yield (
            f'<rect x="{block.x:g}" y="{block.y:g}" width="{WIDTH}" height="{block.height:g}" rx="8"'
            f' fill="#f6f8fa" stroke="{color}" stroke-width="{3 if block.sign else 1}"{dash}/>'
        )
        yield _text(block.x + 12, block.y + (20 if block.kind else 28), block.title, size=14, weight=600)
        if block.kind:
            yield _text(block.x + 12, block.y + 37, block.kind, size=12, color="#57606a")
        for number, note in enumerate(block.notes):
            yield _text(block.x + 12, block.y + HEIGHT + 8 + LINE * number, note, size=12, color=color)
        if block.sign:
            yield f'<circle cx="{block.x + WIDTH:g}" cy="{block.y:g}" r="11" fill="{color}"/>'
            sign = _text(block.x + WIDTH, block.y + 5, block.sign, size=15, weight=700, color="#ffffff")
            yield sign.replace("<text ", '<text text-anchor="middle" ', 1)
        yield "</g>"


def _text(  # noqa: PLR0913 - each is an attribute
    x: float, y: float, words: str, *, size: int, weight: int = 400, color: str = "#1f2328"
) -> str:
    at = f'x="{x:g}" y="{y:g}" font-size="{size}" font-weight="{weight}" fill="{color}"'
    return f"<text {at}>{escape(words)}</text>"


def _cut(words: str, most: int = CHARACTERS) -> str:
    plain = shown(words)
    return plain if len(plain) <= most else f"{plain[: most - 1]}…"
