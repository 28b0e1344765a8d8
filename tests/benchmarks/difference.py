"""The comparison of two versions of a tree of 2,000 nodes, with ids and without.

Run alone with `python -m tests.benchmarks difference`.
"""

from __future__ import annotations

import sys
from functools import partial
from typing import TYPE_CHECKING

from tests.benchmarks.figures import Figure, show
from tests.benchmarks.timing import best_s, peak_mb
from tests.benchmarks.translator import made_tree
from tests.shared.make_differences import edited, lucky, under_new_ids
from translator.diagram import to_diagram
from translator.difference import compare

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

SIZE = 2_000
EDITS = 50


def deep(size: int) -> dict[str, object]:
    """A tree of one long chain, the worst shape for a matching without ids."""
    nodes = {f"n{number}": {"type": "Inverter", "children": [f"n{number + 1}"]} for number in range(size - 1)}
    nodes[f"n{size - 1}"] = {"type": "AlwaysSuccess"}
    return {**to_diagram(made_tree(1)), "nodes": nodes, "root": "n0"}


def measure(_: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the time, memory and number of operations of each case; the target is 200 ms."""
    luck = lucky(1)
    wide = to_diagram(made_tree(SIZE))
    edit = edited(luck, wide, EDITS)
    chain = deep(SIZE)
    half = {**chain, "nodes": {**chain["nodes"], "n1000": {"type": "ForceSuccess", "children": ["n1001"]}}}  # type: ignore[dict-item]
    cases = {
        "by ids": (wide, edit),
        "without ids": (wide, under_new_ids(edit, "x")),
        "nothing in common": (wide, under_new_ids(deep(SIZE), "x")),
        "a chain without ids": (chain, under_new_ids(half, "x")),
    }
    for name, (older, newer) in cases.items():
        work = partial(compare, older, newer)
        yield Figure(f"{SIZE:,} nodes, {name}", best_s(work) * 1e3, "ms")
        yield Figure(f"{SIZE:,} nodes, {name}, Python's objects", peak_mb(work), "MB")
        yield Figure(f"{SIZE:,} nodes, {name}, operations", len(work()), "")


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
