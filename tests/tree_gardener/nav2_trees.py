"""Helpers of the tests of Nav2's nodes; their rules are proven by `controls.jsonl.gz`, made by Nav2's C++."""

from __future__ import annotations

from typing import Any

from tests.tree_gardener.trees import load, recording
from translator import inspect_action
from tree_gardener import Status, Tree
from tree_gardener.actions import load_actions
from tree_gardener.nav2_library import source_of, table

LETTERS = {"S": Status.SUCCESS, "F": Status.FAILURE, "R": Status.RUNNING, "K": Status.SKIPPED}


def nav2_tree(cls: type, children: list[str], ports: str = "", **more: Any) -> Tree:
    """A tree whose root is a node of Nav2; each child returns the letters of its text, one a tick."""
    # The source is a project's action as it stands.
    source = source_of(cls.__name__)
    assert source is not None
    found = inspect_action(source, f"actions/{cls.__name__}.py")
    assert found.diagnostics == ()
    assert found.kind == table()[cls.__name__]["kind"]
    nodes: dict[str, Any] = dict(load_actions({cls.__name__: source}))
    for index, letters in enumerate(children):
        nodes[f"C{index}"] = recording(*(LETTERS[letter] for letter in letters))
    body = "".join(f"<C{index}/>" for index in range(len(children)))
    return load(f"<{cls.__name__} {ports}>{body}</{cls.__name__}>", nodes=nodes, **more)


def ticks(tree: Tree, count: int) -> str:
    """The letters of the root's results."""
    return "".join(tree.tick_exactly_once().letter for _ in range(count))
