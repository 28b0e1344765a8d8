"""The kind of an action's class and its number of children, read from its syntax tree.

A control node or decorator derives from a class of the engine or of py_trees. If the base class is in another
file, `NODE_KIND` is the kind.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from translator.action_ports import ATTRIBUTES as PORTS
from translator.action_ports import assigned

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

KINDS = {
    "Action": "action",
    "SyncAction": "action",
    "Condition": "condition",
    "Control": "control",
    "Decorator": "decorator",
}
LIMITS: dict[str, tuple[int, int | None]] = {"control": (1, None), "decorator": (1, 1)}
_CONTROLS = {
    *("tree_gardener.ControlNode", "tree_gardener.control_node.ControlNode", "tree_gardener.node.Control"),
    *(f"py_trees.composites.{name}" for name in ("Composite", "Parallel", "Selector", "Sequence")),
}
_LOOPS = {"tree_gardener.LoopNode", "tree_gardener.control_node.LoopNode"}
_DECORATORS = {
    *("tree_gardener.DecoratorNode", "tree_gardener.control_node.DecoratorNode"),
    *("tree_gardener.node.Decorator", *_LOOPS),
}
_PY_TREES_DECORATORS = "py_trees.decorators."
_BEHAVIOURS = {"py_trees.behaviour.Behaviour", "py_trees.Behaviour"}


def qualified_bases(module: ast.Module, lineage: Iterable[ast.ClassDef]) -> list[str]:
    """Returns the bases of some classes by their full names, as the module imports them."""
    names = dict(_imported(module))
    found = []
    for cls in lineage:
        for base in cls.bases:
            first, dot, rest = ast.unparse(base).partition(".")
            found.append(names.get(first, first) + dot + rest)
    return found


def _imported(module: ast.Module) -> Iterator[tuple[str, str]]:
    """Yields each name that a module imports, with its full name."""
    for node in module.body:
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.asname:
                    yield alias.asname, alias.name
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            for alias in node.names:
                yield alias.asname or alias.name, f"{node.module}.{alias.name}"


def kind_by_bases(bases: Iterable[str]) -> tuple[str, str]:
    """Returns the kind of a class by its bases, and the base that decides it; "" if none of them is known."""
    known = ""
    for base in bases:
        if base in _CONTROLS:
            return "control", base
        if base in _DECORATORS or base.startswith(_PY_TREES_DECORATORS):
            return "decorator", base
        if base in _BEHAVIOURS:
            known = base
    return "action", known


def is_loop(bases: Iterable[str]) -> bool:
    """Returns whether a class is a loop over elements of a type."""
    return not _LOOPS.isdisjoint(bases)


def without_effect(lineage: Iterable[ast.ClassDef], report: Callable[..., None]) -> None:
    """Reports what a loop declares although its rule and its ports are those of LoopNode."""
    for cls in lineage:
        for node in cls.body:
            names = [name for name in PORTS if assigned(node, name) is not None]
            if isinstance(node, ast.FunctionDef) and node.name == "update":
                names.append("update")
            for name in names:
                report("BT0620", node, attribute=name)


def children_of(
    lineage: Iterable[ast.ClassDef], kind: str, report: Callable[..., None]
) -> tuple[int, int | None]:
    """Returns the smallest and the largest number of children; None means any number."""
    if kind not in LIMITS:
        return 0, 0
    least, most = LIMITS[kind]
    given: dict[str, tuple[ast.stmt, ast.expr]] = {}
    for cls in lineage:
        for node in cls.body:
            for name in ("MIN_CHILDREN", "MAX_CHILDREN"):
                value = assigned(node, name)
                if value is not None:
                    given.setdefault(name, (node, value))
    if kind == "decorator":
        for name, (node, value) in given.items():
            if not (isinstance(value, ast.Constant) and value.value == 1):
                report("BT0619", node, attribute=name)
        return least, most
    least = _number(given, "MIN_CHILDREN", report, least=1) or least
    return least, _number(given, "MAX_CHILDREN", report, least=least)


def _number(
    given: dict[str, tuple[ast.stmt, ast.expr]], name: str, report: Callable[..., None], *, least: int
) -> int | None:
    """Returns a number of children as it is written; reports one that the engine would refuse."""
    if name not in given:
        return None
    node, value = given[name]
    if isinstance(value, ast.Constant):
        number = value.value
        if type(number) is int and number >= least:
            return number
        if number is None and name == "MAX_CHILDREN":
            return None
    report("BT0615", node, attribute=name, least=least)
    return None
