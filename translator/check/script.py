"""Checks of scripts: conditions of any node, and the ports that hold code."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from translator.script_names import MAX_INTEGER, integers_too_large, script_names
from translator.text import excerpt
from translator.tree import pointer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.check.context import Context
    from translator.tree import Node, Tree


_DOTTED = re.compile(r"[A-Za-z_]\w*\.[A-Za-z_]")


def scripts_of(context: Context, node: Node) -> Iterator[tuple[str, str]]:
    """Yields the attribute and the code of each script of a node."""
    yield from node.conditions.items()
    model = context.model(node.type)
    if model is None:
        return
    for port in model.ports.values():
        text = node.ports.get(port.name) if port.type == "script" else None
        # A script may be in a blackboard entry; the engine reads it from there when the node is ticked.
        if text is not None and pointer(text, port.name) is None:
            yield port.name, text


def check_scripts(context: Context) -> None:
    """Reports scripts that the engine could not read."""
    for tree in context.project.trees.values():
        for node in tree.walk():
            for attribute, code in scripts_of(context, node):
                _check_script(context, tree, node, attribute, code)
            if node.type == "RosSubscribe" and (condition := node.ports.get("condition")):
                _check_field_condition(context, tree, node, condition)


def _check_field_condition(context: Context, tree: Tree, node: Node, code: str) -> None:
    """Checks a script over the fields of a message, whose names are no entries of the blackboard."""
    if code.strip() and pointer(code, "condition") is None:
        advice = "Write a field of a field with __: pose__position__x." if _DOTTED.search(code) else ""
        _check_script(context, tree, node, "condition", code, advice=advice)


def _check_script(  # noqa: PLR0913 - the place has three parts
    context: Context, tree: Tree, node: Node, attribute: str, code: str, *, advice: str = ""
) -> None:
    if not code.strip():
        if code or node.type != "Script" or attribute in node.conditions:  # a Script's own may be empty
            context.report("BT0301", tree, node, attribute, attribute=attribute)
        return
    for number in integers_too_large(code):
        context.report("BT0304", tree, node, attribute, attribute=attribute, number=number, limit=MAX_INTEGER)
    problem = script_names(code).problem
    if problem is None:
        return
    message = problem.message[:1].lower() + problem.message[1:].rstrip(".")
    context.report(
        "BT0302",
        tree,
        node,
        attribute,
        attribute=attribute,
        problem=f"{message}, at character {problem.offset + 1} of “{excerpt(code, problem.offset)}”",
        advice=advice or problem.hint or "See the page on the script language.",
    )
