"""Values of the wrong type for fields of ROS messages, read from a source's syntax tree without running it.

Only what is sure is found: literals, and what surely is an int or a text, given to a message that the same
function makes, or to the constructor of its class.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from translator.action_waits import dotted_name, imported_names
from translator.installed_interfaces import installed_fields
from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["WrongField", "wrong_fields"]

_REALS: Final = ("float", "double")
_WHOLES: Final = frozenset(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64))
_TEXTS: Final = ("string", "wstring")
_CALLS: Final = {name: name for name in ("int", "str", "float", "bool")} | {
    "len": "int",
    "repr": "str",
    **{f"numpy.{name}": f"numpy.{name}" for name in ("float32", "int32", "int64")},
}
_PORTS: Final = dict.fromkeys(("int", "int64", "uint"), "int") | {
    "double": "float",
    "string": "str",
    "bool": "bool",
}
_WHOLE_OPERATORS: Final = (ast.Add, ast.Sub, ast.Mult, ast.FloorDiv)
_GET_INPUT: Final = "tree_gardener.ports.get_input"
_Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True, slots=True)
class WrongField:
    """A field that does not take a value, or does not exist.

    Attributes:
        line: its line in the source.
        field: its name after that of its message, as ``geometry_msgs/Vector3.x``.
        wanted: the type that it takes; "" if the message has no such field.
        given: what it is given; the fields that there are, if it does not exist.
        remedy: what to write.
    """

    line: int
    field: str
    wanted: str = ""
    given: str = ""
    remedy: str = ""


def wrong_fields(source: str, path: str, ports: Mapping[str, str] | None = None) -> list[WrongField]:
    """Returns what is wrong in a source, in the order of its lines.

    Args:
        source: the text of the file.
        path: its name.
        ports: the type of each input port of the action.
    """
    if ".msg" not in source:
        return []
    try:
        module = parse(source, path)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    names = imported_names(module)
    functions = [node for node in ast.walk(module) if isinstance(node, _Function)]
    inner = {id(node) for function in functions for node in _own_nodes(function)}
    outer = _Scope([node for node in ast.walk(module) if id(node) not in inner], names, ports or {})
    found = set(outer.wrong())
    constants = {name: value for name, value in outer.values.items() if name not in _shared(module)}
    for function in functions:
        found.update(_Scope(list(_own_nodes(function)), names, ports or {}, constants).wrong())
    return sorted(found, key=lambda one: (one.line, one.field))


class _Scope:
    """The statements of one function, without those of functions in it."""

    def __init__(
        self,
        nodes: list[ast.AST],
        names: Mapping[str, str],
        ports: Mapping[str, str],
        outer: Mapping[str, ast.expr] | None = None,
    ) -> None:
        self._nodes = nodes
        self._names = names
        self._ports = ports
        self.values: dict[str, ast.expr] = self._assigned_once(outer or {})
        """The values of names that are bound once, by a plain assignment."""

    def wrong(self) -> Iterator[WrongField]:
        """Yields the fields that are given wrong values."""
        for node in self._nodes:
            if isinstance(node, ast.Call) and (kind := self._message(node)):
                yield from self._of_constructor(node, kind)
            elif isinstance(node, ast.Assign):
                for target in node.targets:
                    if isinstance(target, ast.Attribute):
                        yield from self._of_assignment(target, node.value)

    def _assigned_once(self, outer: Mapping[str, ast.expr]) -> dict[str, ast.expr]:
        bound: dict[str, int] = {}
        values: dict[str, ast.expr] = {}
        for node in self._nodes:
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store | ast.Del):
                bound[node.id] = bound.get(node.id, 0) + 1
            elif isinstance(node, ast.Global | ast.Nonlocal):
                bound |= dict.fromkeys(node.names, 2)
            elif isinstance(node, ast.arg):
                bound[node.arg] = 2
            if isinstance(node, ast.Assign) and len(node.targets) == 1:
                target = node.targets[0]
                if isinstance(target, ast.Name):
                    values[target.id] = node.value
        own = {name: value for name, value in values.items() if bound.get(name) == 1}
        return {name: value for name, value in outer.items() if name not in bound} | own

    def _message(self, value: ast.expr | None) -> str:
        """Returns the name of the message that a value surely is, as ``geometry_msgs/msg/Twist``; else ""."""
        if isinstance(value, ast.Name):
            value = self.values.get(value.id)
        if not isinstance(value, ast.Call):
            return ""
        parts = dotted_name(value.func, self._names).split(".")
        if len(parts) != 3 or parts[1] != "msg":
            return ""
        name = "/".join(parts)
        return name if installed_fields(name, parts[2]) else ""

    def _of_constructor(self, call: ast.Call, kind: str) -> Iterator[WrongField]:
        for keyword in call.keywords:
            if keyword.arg is not None and keyword.arg != "check_fields":
                yield from self._given(kind, keyword.arg, keyword.value, keyword.value.lineno)

    def _of_assignment(self, target: ast.Attribute, value: ast.expr) -> Iterator[WrongField]:
        parts = [target.attr]
        owner = target.value
        while isinstance(owner, ast.Attribute):
            parts.append(owner.attr)
            owner = owner.value
        kind = self._message(owner) if isinstance(owner, ast.Name) else ""
        for part in reversed(parts[1:]):
            kind = _full(_fields(kind).get(part, "")) if kind else ""
        if kind and _fields(kind):
            yield from self._given(kind, parts[0], value, target.lineno)

    def _given(self, kind: str, field: str, value: ast.expr, line: int) -> Iterator[WrongField]:
        fields = _fields(kind)
        package, _, short = kind.split("/")
        name = f"{package}/{short}"
        if field not in fields:
            yield WrongField(line, f"{name}.{field}", given=", ".join(fields))
            return
        for one in _branches(value):
            given = self._type(one)
            if wanted := _mismatch(fields[field], given):
                shown, remedy = _shown(one, given), _remedy(fields[field], one)
                yield WrongField(line, f"{name}.{field}", wanted, shown, remedy)

    def _type(self, value: ast.expr, depth: int = 5) -> str:
        """Returns the Python type that a value surely has, or the name of its message; else ""."""
        found = ""
        if isinstance(value, ast.Constant):
            found = type(value.value).__name__
        elif isinstance(value, ast.JoinedStr):
            found = "str"
        elif isinstance(value, ast.Call):
            found = self._message(value) or self._called(value)
        elif depth and isinstance(value, ast.Name) and value.id in self.values:
            found = self._type(self.values[value.id], depth - 1)
        elif depth and isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.USub | ast.UAdd):
            found = self._type(value.operand, depth - 1)
        elif depth and isinstance(value, ast.BinOp) and isinstance(value.op, _WHOLE_OPERATORS):
            both = {self._type(value.left, depth - 1), self._type(value.right, depth - 1)}
            found = "int" if both == {"int"} else ""
        return found

    def _called(self, call: ast.Call) -> str:
        name = dotted_name(call.func, self._names)
        if name == "round" and len(call.args) == 1 and not call.keywords:
            return "int"
        if name == _GET_INPUT and len(call.args) == 2 and isinstance(call.args[1], ast.Constant):
            return _PORTS.get(self._ports.get(str(call.args[1].value), ""), "")
        return _CALLS.get(name, "")


def _shared(module: ast.Module) -> set[str]:
    """Returns the names of the module that functions bind."""
    return {name for node in ast.walk(module) if isinstance(node, ast.Global) for name in node.names}


def _own_nodes(function: _Function) -> Iterator[ast.AST]:
    """Yields the nodes of a function but those of functions and classes in it."""
    waiting: list[ast.AST] = [function.args, *function.body]
    while waiting:
        node = waiting.pop()
        if isinstance(node, _Function | ast.ClassDef | ast.Lambda):
            continue
        yield node
        waiting += ast.iter_child_nodes(node)


def _branches(value: ast.expr) -> Iterator[ast.expr]:
    if isinstance(value, ast.IfExp):
        yield from _branches(value.body)
        yield from _branches(value.orelse)
    else:
        yield value


def _fields(kind: str) -> Mapping[str, str]:
    return installed_fields(kind, kind.rpartition("/")[2]) or {} if kind else {}


def _full(kind: str) -> str:
    """Returns ``geometry_msgs/msg/Vector3`` for the type of a field; "" for other types than messages."""
    package, slash, short = kind.partition("/")
    return f"{package}/msg/{short}" if slash and short.isidentifier() and package.isidentifier() else ""


def _mismatch(kind: str, given: str) -> str:
    """Returns the type that a field takes, if a value of that Python type is not it; else ""."""
    if not given:
        return ""
    taken: tuple[str, ...] = ()
    if kind in _REALS:
        taken = ("float",)
    elif kind in _WHOLES:
        taken = ("int", "bool")
    elif kind in _TEXTS:
        taken = ("str",)
    elif kind == "boolean":
        taken = ("bool",)
    elif full := _full(kind):
        return "" if given == full else kind
    elif "[" in kind or "<" in kind:
        return "list" if given in ("int", "float", "bool", "NoneType") else ""
    return taken[0] if taken and given not in taken else ""


def _shown(value: ast.expr, given: str) -> str:
    text = ast.unparse(value)
    text = text if len(text) <= 40 else f"{text[:39]}…"
    if "/" in given:
        package, _, short = given.split("/")
        return f"{package}/{short}"
    return text if isinstance(value, ast.Constant) else f"{text}, of type {given}"


def _remedy(kind: str, value: ast.expr) -> str:
    number = _number(value)
    if kind in _REALS:
        return "float(…)" if number is None else str(float(number))
    if kind in _WHOLES:
        return str(int(number)) if number is not None and number == int(number) else "int(…)"
    if kind in _TEXTS:
        return "str(…)"
    if kind == "boolean":
        return "bool(…)" if number is None else str(bool(number))
    return f"{kind.rpartition('/')[2]}(…)" if "/" in kind else "[…]"


def _number(value: ast.expr) -> int | float | None:
    try:
        number = ast.literal_eval(value)
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
        return None
    if type(number) not in (int, float) or abs(number) > 2**53:
        return None
    return number  # type: ignore[no-any-return]
