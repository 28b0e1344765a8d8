"""Checks of the actions that the trees use; findings in their sources are reported when they are loaded."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING

from translator.action import source_text
from translator.action_returns import returns_of
from translator.diagnostic import Place, diagnostic
from translator.python_source import parse
from translator.text import is_clean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.action import ActionModel
    from translator.check.context import Context
    from translator.diagnostic import Diagnostic


def check_actions(context: Context) -> None:
    """Reports actions that are used but have no code yet."""
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    used = {node.type: (tree, node) for tree in context.project.trees.values() for node in tree.walk()}
    for name, action in context.project.actions.items():
        if name in used and is_stub(action.source):
            tree, node = used[name]
            context.report("BT0613", tree, node, name=name, path=action.path)
        if not is_clean(source_text(action)):
            place = Place(action.path, line=1)
            context.found.append(diagnostic("BT0614", place))
        context.found.extend(_unknown_types(action))
        if name in used and (returns := returns_of(action.source, name)).problem:
            place = Place(action.path, line=returns.line)
            context.found.append(diagnostic("BT0617", place, name=name, problem=returns.problem))


def _unknown_types(action: ActionModel) -> Iterator[Diagnostic]:
    """Yields a finding for each port whose type is a text that names no enumeration."""
    ports = [port for port in action.ports if port.type == "any" and port.named.isidentifier()]
    known = _names_in(action) if ports else set()
    for port in ports:
        if port.named not in known:
            at = re.search(rf"""["']{port.named}["']""", action.source)
            line = action.source.count("\n", 0, at.start()) + 1 if at else action.line
            yield diagnostic(
                "BT0616", Place(action.path, port=port.name, line=line), port=port.name, type=port.named
            )


def _names_in(action: ActionModel) -> set[str]:
    """Returns the classes and modules that a source knows by name, such as those that it registers."""
    try:
        module = parse(action.source, action.path)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    return {
        name
        for node in ast.walk(module)
        for name in (getattr(node, "id", ""), getattr(node, "name", ""), getattr(node, "asname", ""))
        if isinstance(name, str)
    }
