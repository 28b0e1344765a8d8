"""The kind of an action's class and its number of children, read from its syntax tree.

A control node or decorator derives from a class of the engine or of py_trees. If the base class is in another
file, `NODE_KIND` is the kind.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from translator.action_ports import ATTRIBUTES as PORTS
from translator.action_ports import assigned, assignments

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

KINDS = {
    "Action": "action",
    "StatefulAction": "action",
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
_ADDING = {"add_child", "add_children", "insert_child", "prepend_child"}
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
    lineage: Sequence[ast.ClassDef], kind: str, base: str, report: Callable[..., None]
) -> tuple[int, int | None]:
    """Returns the smallest and the largest number of children; None means any number.

    A composite or decorator of py_trees may make its children itself, in its constructor.
    """
    if kind not in LIMITS:
        return 0, 0
    least, most = LIMITS[kind]
    if base.startswith("py_trees.") and (init := _constructor(lineage)) is not None:
        if kind == "control" and _adds_children(init):
            return 0, most
        if kind == "decorator" and not _takes_child(init):
            return 0, 0
    given: dict[str, tuple[ast.stmt, ast.expr]] = {}
    for name in ("MIN_CHILDREN", "MAX_CHILDREN"):
        found = assignments(lineage, name)
        if found:
            given[name] = found[-1]
    if kind == "decorator":
        for name, (node, value) in given.items():
            if not (isinstance(value, ast.Constant) and value.value == 1):
                report("BT0619", node, attribute=name)
        return least, most
    least = _number(given, "MIN_CHILDREN", report, least=1) or least
    return least, _number(given, "MAX_CHILDREN", report, least=least)


def _constructor(lineage: Iterable[ast.ClassDef]) -> ast.FunctionDef | None:
    """Returns the constructor that the most derived of some classes has."""
    return next(
        (
            node
            for cls in lineage
            for node in cls.body
            if isinstance(node, ast.FunctionDef) and node.name == "__init__"
        ),
        None,
    )


def _adds_children(init: ast.FunctionDef) -> bool:
    """Returns whether a constructor gives its composite children."""
    calls = [node for node in ast.walk(init) if isinstance(node, ast.Call)]
    methods = {call.func.attr for call in calls if isinstance(call.func, ast.Attribute)}
    names = {keyword.arg for call in calls for keyword in call.keywords}
    return not methods.isdisjoint(_ADDING) or "children" in names


def _takes_child(init: ast.FunctionDef) -> bool:
    """Returns whether a constructor takes the child of its decorator."""
    given = init.args
    names = {each.arg for each in (*given.posonlyargs, *given.args, *given.kwonlyargs)}
    return "child" in names or given.kwarg is not None


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
