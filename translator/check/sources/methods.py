"""The methods that the engine calls: their parameters, and the ends of `update`."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from translator.action_kind import is_loop, qualified_bases
from translator.check.sources.found import Found, Moment, found_at

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

_BEHAVIOURS: Final = {"py_trees.behaviour.Behaviour", "py_trees.Behaviour"}
_CONTROLS: Final = {
    f"tree_gardener.{module}{name}"
    for module in ("", "control_node.")
    for name in ("ControlNode", "DecoratorNode")
}
_COMPOSITES: Final = ("py_trees.composites.", "py_trees.decorators.")
_LATER: Final = {
    "initialise": (),
    "update": (),
    "terminate": ("new_status",),
    "shutdown": (),
}
_ENDLESS: Final = {"exit", "_exit", "abort", "quit"}


class Methods:
    """The methods of the class that a file is loaded for.

    Args:
        module: the syntax tree of the file.
        name: the name of the class.
    """

    def __init__(self, module: ast.Module, name: str) -> None:
        self._name = name
        classes = {node.name: node for node in module.body if isinstance(node, ast.ClassDef)}
        self._lineage = _lineage(classes, name)
        bases = qualified_bases(module, self._lineage)
        self._is_composite = any(base.startswith(_COMPOSITES) for base in bases)
        self._is_decorator = any(base.startswith(_COMPOSITES[1]) for base in bases)
        is_known = self._is_composite or any(base in _BEHAVIOURS | _CONTROLS for base in bases)
        self._is_action = any(base in _BEHAVIOURS for base in bases)
        self._is_read = is_known and not is_loop(bases)

    def made(self) -> list[ast.FunctionDef]:
        """Returns the methods that surely run before the first tick."""
        names = ("__init__",) if self._is_composite else ("__init__", "setup")
        found = [self._method(name) for name in names] if self._is_read else []
        return [method for method in found if method is not None]

    def findings(self) -> Iterator[Found]:
        """Yields calls of the engine that a method does not take, and ends of `update` without a status."""
        if not self._is_read:
            return
        if (method := self._method("__init__")) is not None:
            names = {argument.arg for argument in _parameters(method.args)}
            takes_child = self._is_decorator and ("child" in names or method.args.kwarg is not None)
            keywords = ["child"] if takes_child else ["ports"] if self._takes_ports(names) else []
            yield from self._refused(method, ["name"], keywords, Moment.MAKE)
        if self._is_composite:
            return
        if (method := self._method("setup")) is not None:
            names = {argument.arg for argument in _parameters(method.args)}
            yield from self._refused(method, [], ["node"] if "node" in names else [], Moment.MAKE)
        if self._is_action:
            for name, given in _LATER.items():
                if (method := self._method(name)) is not None:
                    yield from self._refused(method, given, [], Moment.LATER)
        if (method := self._method("update")) is not None:
            yield from self._ends(method)

    def _takes_ports(self, names: set[str]) -> bool:
        return not self._is_composite and "ports" in names

    def _method(self, name: str) -> ast.FunctionDef | None:
        """Returns a plain method as the class has it; None if a base that is not in this file may have it."""
        for cls in self._lineage:
            found = [node for node in cls.body if name in _bound_by(node)]
            if found:
                method = found[-1]
                is_plain = isinstance(method, ast.FunctionDef) and not method.decorator_list
                return method if is_plain and isinstance(method, ast.FunctionDef) else None
            if cls.decorator_list or len(cls.bases) != 1:
                return None
        return None

    def _refused(
        self, method: ast.FunctionDef, given: Sequence[str], keywords: Sequence[str], moment: Moment
    ) -> Iterator[Found]:
        problem = _problem(method.args, given, keywords)
        if problem:
            call = ", ".join((*given, *(f"{keyword}=…" for keyword in keywords)))
            if method.name == "setup" and not keywords:
                call = "node=…"
            values = {"method": method.name, "name": self._name, "call": f"{method.name}({call})"}
            yield found_at("BT0645", method, moment, **values, problem=problem)

    def _ends(self, update: ast.FunctionDef) -> Iterator[Found]:
        nodes = list(_inside(update))
        if any(isinstance(node, ast.Yield | ast.YieldFrom) for node in nodes):
            yield found_at("BT0646", update, Moment.LATER, name=self._name)
            return
        empty = [node for node in nodes if isinstance(node, ast.Return) and _is_none(node.value)]
        for node in empty[:1]:
            yield found_at("BT0646", node, Moment.LATER, name=self._name)
        if not empty and falls(update.body):
            yield found_at("BT0646", update, Moment.LATER, name=self._name)


def _lineage(classes: dict[str, ast.ClassDef], name: str) -> list[ast.ClassDef]:
    """Returns the class and its first bases that are in the file, nearest first."""
    line: list[ast.ClassDef] = []
    while name in classes and classes[name] not in line:
        line.append(classes[name])
        first = line[-1].bases[0] if line[-1].bases else None
        name = first.id if isinstance(first, ast.Name) else ""
    return line


def _bound_by(node: ast.stmt) -> set[str]:
    """Returns the names that a statement of a class binds."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return {node.name}
    return {
        part.id for part in ast.walk(node) if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)
    } | {part.name for part in ast.walk(node) if isinstance(part, ast.FunctionDef | ast.AsyncFunctionDef)}


def _parameters(arguments: ast.arguments) -> list[ast.arg]:
    more = [each for each in (arguments.vararg, arguments.kwarg) if each is not None]
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *more]


def _problem(arguments: ast.arguments, given: Sequence[str], keywords: Sequence[str]) -> str:
    """Returns why a method cannot be called so, or ""."""
    plain = [*arguments.posonlyargs, *arguments.args]
    count = 1 + len(given)
    if len(plain) < count and arguments.vararg is None:
        return "it has no self" if not plain else f"it takes no {given[len(plain) - 1]}"
    open_ = plain[count:]
    mandatory = open_[: max(0, len(open_) - len(arguments.defaults))]
    asked = [each.arg for each in mandatory]
    asked += [
        each.arg
        for each, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
        if default is None
    ]
    missing = [name for name in asked if name not in keywords]
    if missing:
        return f"{', '.join(missing)} {'has' if len(missing) == 1 else 'have'} no default"
    takes = {
        each.arg
        for each in (*arguments.args[max(0, count - len(arguments.posonlyargs)) :], *arguments.kwonlyargs)
    }
    refused = [name for name in keywords if name not in takes and arguments.kwarg is None]
    return f"it takes no {refused[0]}" if refused else ""


def _inside(function: ast.FunctionDef) -> Iterator[ast.AST]:
    """Yields the nodes of a function, without those of functions and classes in it."""
    stack: list[ast.AST] = list(function.body)
    while stack:
        node = stack.pop()
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda | ast.ClassDef):
            stack.extend(reversed(list(ast.iter_child_nodes(node))))


def _is_none(value: ast.expr | None) -> bool:
    return value is None or (isinstance(value, ast.Constant) and value.value is None)


def falls(body: Sequence[ast.stmt]) -> bool:
    """Returns whether control can reach the end of some statements."""
    return all(_passes(statement) for statement in body)


def _passes(node: ast.stmt) -> bool:  # noqa: PLR0911 - one a kind
    """Returns whether control can pass a statement."""
    if isinstance(node, ast.Return | ast.Raise | ast.Continue | ast.Break):
        return False
    if isinstance(node, ast.If):
        return falls(node.body) or falls(node.orelse)
    if isinstance(node, ast.While):
        is_endless = isinstance(node.test, ast.Constant) and bool(node.test.value)
        return not is_endless or _breaks(node.body)
    if isinstance(node, ast.Try | ast.TryStar):
        if node.finalbody and not falls(node.finalbody):
            return False
        whole = falls(node.body) and falls(node.orelse)
        return whole or any(falls(handler.body) for handler in node.handlers)
    if isinstance(node, ast.With | ast.AsyncWith):
        return falls(node.body)
    if isinstance(node, ast.Match):
        is_whole = any(_takes_all(case) for case in node.cases)
        return not is_whole or any(falls(case.body) for case in node.cases)
    if isinstance(node, ast.Assert):
        return not (isinstance(node.test, ast.Constant) and not node.test.value)
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
        function = node.value.func
        return getattr(function, "attr", getattr(function, "id", "")) not in {*_ENDLESS, "assert_never"}
    return True


def _takes_all(case: ast.match_case) -> bool:
    return case.guard is None and isinstance(case.pattern, ast.MatchAs) and case.pattern.pattern is None


def _breaks(body: Sequence[ast.stmt]) -> bool:
    stack: list[ast.AST] = list(body)
    while stack:
        node = stack.pop()
        if isinstance(node, ast.Break):
            return True
        if not isinstance(node, ast.For | ast.AsyncFor | ast.While | ast.FunctionDef | ast.ClassDef):
            stack.extend(ast.iter_child_nodes(node))
        elif isinstance(node, ast.For | ast.AsyncFor | ast.While):
            stack.extend(node.orelse)
    return False
