"""The results that an action's `update` can return, read from its syntax tree."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterator

_STATUSES: Final = frozenset(("SUCCESS", "FAILURE", "RUNNING", "SKIPPED"))
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def returned_statuses(source: str, name: str) -> frozenset[str]:
    """Returns the statuses that `update` of the class `name` returns; empty if they are not plain to see.

    They are plain if each of its returns names one, as in ``return py_trees.common.Status.RUNNING``.
    """
    try:
        module = parse(source, f"actions/{name}.py")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return frozenset()
    for cls in module.body:
        if isinstance(cls, ast.ClassDef) and cls.name == name:
            for item in cls.body:
                if isinstance(item, ast.FunctionDef) and item.name == "update":
                    return _of(item)
    return frozenset()


def _of(update: ast.FunctionDef) -> frozenset[str]:
    found: set[str] = set()
    for value in _returns(update):
        names = _names(value)
        if not names:
            return frozenset()
        found |= names
    return frozenset(found)


def _returns(update: ast.FunctionDef) -> Iterator[ast.expr | None]:
    stack: list[ast.AST] = list(update.body)
    while stack:
        node = stack.pop()
        if isinstance(node, ast.Return):
            yield node.value
        if not isinstance(node, _SCOPES):
            stack.extend(ast.iter_child_nodes(node))


def _names(value: ast.expr | None) -> frozenset[str]:
    if isinstance(value, ast.IfExp):
        one, other = _names(value.body), _names(value.orelse)
        return one | other if one and other else frozenset()
    if isinstance(value, ast.Attribute) and value.attr in _STATUSES:
        owner = value.value
        last = owner.attr if isinstance(owner, ast.Attribute) else getattr(owner, "id", "")
        return frozenset((value.attr,)) if last == "Status" else frozenset()
    return frozenset()
