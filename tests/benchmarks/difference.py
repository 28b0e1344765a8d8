"""The comparison of two versions of a tree of 2,000 nodes, with ids and without.

Run alone with `python -m tests.benchmarks difference`.
"""

from __future__ import annotations

from functools import partial

from tests.benchmarks.translator import made_tree, measured
from tests.shared.make_differences import edited, lucky, under_new_ids
from translator.diagram import to_diagram
from translator.difference import compare

SIZE = 2_000
EDITS = 50
TARGET_S = 0.2


def deep(size: int) -> dict[str, object]:
    """A tree of one long chain, the worst shape for a matching without ids."""
    nodes = {f"n{number}": {"type": "Inverter", "children": [f"n{number + 1}"]} for number in range(size - 1)}
    nodes[f"n{size - 1}"] = {"type": "AlwaysSuccess"}
    return {**to_diagram(made_tree(1)), "nodes": nodes, "root": "n0"}


def main() -> None:
    """Prints a line for each case."""
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
    print(f"{'difference, 2,000 nodes':24} {'ms':>9} {'operations':>11} {'peak MB':>9}   target 200 ms")
    for name, (older, newer) in cases.items():
        seconds, peak = measured(partial(compare, older, newer))
        print(f"{name:24} {seconds * 1e3:9.1f} {len(compare(older, newer)):11} {peak:9.1f}")


if __name__ == "__main__":
    main()
