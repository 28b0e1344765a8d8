"""Reads ROS endpoints in the Python of a project by syntax alone: topics, services, actions, parameters.

A name or type is known if the source states it: as text, as a constant of the module or class, or as a
combination of these. For a name that is computed at run time, the expression is returned.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterator

_MESSAGE = re.compile(r"(\w+)\.(msg|srv|action)\.(\w+)")
_TF = "tf2_msgs.msg.TFMessage"


@dataclass(frozen=True, slots=True, order=True)
class Endpoint:
    """One end of a topic, service or action, or a parameter.

    Attributes:
        name: its name in the source; the expression if `known` is false.
        kind: `publisher`, `subscription`, `client`, `service`, `action client`, `action server`, `parameter`.
        type: its type, such as `geometry_msgs/msg/Twist`; "" if the source does not state it.
        known: whether the name is certain.
        path: the file, and `line` in it.
    """

    name: str
    kind: str
    type: str
    known: bool
    path: str
    line: int


@dataclass(frozen=True, slots=True)
class _Call:
    """The position and keyword of type and name in a call that makes an endpoint."""

    kind: str
    type: tuple[int, str]
    name: tuple[int, str]


_CALLS = {
    "create_publisher": _Call("publisher", (0, "msg_type"), (1, "topic")),
    "create_subscription": _Call("subscription", (0, "msg_type"), (1, "topic")),
    "create_client": _Call("client", (0, "srv_type"), (1, "srv_name")),
    "create_service": _Call("service", (0, "srv_type"), (1, "srv_name")),
    "ActionClient": _Call("action client", (1, "action_type"), (2, "action_name")),
    "ActionServer": _Call("action server", (1, "action_type"), (2, "action_name")),
    "wait_for_message": _Call("subscription", (0, "msg_type"), (2, "topic")),
}
# Classes of `tf2_ros`, and the topics that they open.
_TF_CLASSES = {
    "TransformListener": (("/tf", "subscription"), ("/tf_static", "subscription")),
    "TransformBroadcaster": (("/tf", "publisher"),),
    "StaticTransformBroadcaster": (("/tf_static", "publisher"),),
}


def endpoints(source: str, path: str) -> list[Endpoint]:
    """Returns the endpoints that a Python file opens, in its order; none if it cannot be parsed."""
    try:
        return list(_Reader(parse(source, path), path).found())
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


class _Reader:
    """Reads one module."""

    def __init__(self, module: ast.Module, path: str) -> None:
        self.module = module
        self.path = path
        self.names: dict[str, str] = {}
        self.stars: list[str] = []
        self.constants = _constants(module)
        for node in ast.walk(module):
            self.take_import(node)

    def take_import(self, node: ast.AST) -> None:
        if isinstance(node, ast.Import):
            for alias in node.names:
                top = alias.name.partition(".")[0]
                self.names[alias.asname or top] = alias.name if alias.asname else top
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            for alias in node.names:
                if alias.name == "*":
                    self.stars.append(node.module)
                else:
                    self.names[alias.asname or alias.name] = f"{node.module}.{alias.name}"

    def found(self) -> Iterator[Endpoint]:
        calls = [node for node in ast.walk(self.module) if isinstance(node, ast.Call)]
        for call in sorted(calls, key=lambda node: (node.lineno, node.col_offset)):
            yield from self.of_call(call)

    def of_call(self, call: ast.Call) -> Iterator[Endpoint]:
        called = self.dotted(call.func)
        last = called.rpartition(".")[2]
        if last in _TF_CLASSES:
            for topic, kind in _TF_CLASSES[last]:
                yield self.endpoint(call, kind, topic, known=True, type_=_as_type(_TF))
        elif called == "message_filters.Subscriber":
            yield from self.opened(call, _Call("subscription", (1, "msg_type"), (2, "topic")))
        elif last in _CALLS:
            yield from self.opened(call, _CALLS[last])
        elif last == "declare_parameter" and isinstance(call.func, ast.Attribute):
            yield from self.parameter(call)

    def opened(self, call: ast.Call, shape: _Call) -> Iterator[Endpoint]:
        type_, name = (_argument(call, *place) for place in (shape.type, shape.name))
        if type_ is None or name is None:
            return
        text = self.text_of(name)
        known = text is not None
        shown = text if text is not None else ast.unparse(name)
        yield self.endpoint(call, shape.kind, shown, known=known, type_=_as_type(self.dotted(type_)))

    def parameter(self, call: ast.Call) -> Iterator[Endpoint]:
        name = _argument(call, 0, "name")
        default = _argument(call, 1, "value")
        if name is None or (text := self.text_of(name)) is None:
            return
        shown = ast.unparse(default) if default is not None else ""
        yield self.endpoint(call, "parameter", text, known=True, type_=shown)

    def endpoint(self, call: ast.Call, kind: str, name: str, *, known: bool, type_: str) -> Endpoint:
        return Endpoint(name, kind, type_, known, self.path, call.lineno)

    def text_of(self, node: ast.expr) -> str | None:
        """Returns the text of an expression if it is certain; otherwise None."""
        if isinstance(node, ast.Constant):
            return node.value if isinstance(node.value, str) else None
        if isinstance(node, ast.Name):
            return self.constants.get(node.id)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            return self.constants.get(f".{node.attr}")
        parts: list[str | None] = []
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            parts = [self.text_of(node.left), self.text_of(node.right)]
        elif isinstance(node, ast.JoinedStr):
            parts = [self.text_of_part(part) for part in node.values]
        return "".join(part or "" for part in parts) if parts and None not in parts else None

    def text_of_part(self, part: ast.expr) -> str | None:
        if isinstance(part, ast.FormattedValue):
            plain = part.conversion == -1 and part.format_spec is None
            return self.text_of(part.value) if plain else None
        return self.text_of(part)

    def dotted(self, node: ast.expr) -> str:
        """Returns the full name of an expression, by the imports; "" if the expression is not a name."""
        if isinstance(node, ast.Attribute):
            before = self.dotted(node.value)
            return f"{before}.{node.attr}" if before else node.attr
        if not isinstance(node, ast.Name):
            return ""
        if node.id in self.names:
            return self.names[node.id]
        messages = [star for star in self.stars if star.rpartition(".")[2] in {"msg", "srv", "action"}]
        return f"{messages[0]}.{node.id}" if len(messages) == 1 and node.id[:1].isupper() else node.id


def _argument(call: ast.Call, position: int, keyword: str) -> ast.expr | None:
    for item in call.keywords:
        if item.arg == keyword:
            return item.value
    if len(call.args) <= position or any(isinstance(item, ast.Starred) for item in call.args[: position + 1]):
        return None
    return call.args[position]


def _as_type(dotted: str) -> str:
    match = _MESSAGE.fullmatch(dotted)
    return "/".join(match.groups()) if match else ""


def _constants(module: ast.Module) -> dict[str, str]:
    """Returns the constant texts of the module's names and of its classes' attributes (`.name`)."""
    values: dict[str, list[object]] = {}
    for node in ast.walk(module):
        for target, value in _assigned(node):
            values.setdefault(target, []).append(value.value if isinstance(value, ast.Constant) else None)
    # A name of a class is read through `self` or the class.
    for cls in (node for node in ast.walk(module) if isinstance(node, ast.ClassDef)):
        for statement in cls.body:
            for target, _ in _assigned(statement):
                values.setdefault(f".{target}", []).extend(values.get(target, []))
    return {name: held[0] for name, held in values.items() if len(held) == 1 and isinstance(held[0], str)}


def _assigned(node: ast.AST) -> Iterator[tuple[str, ast.expr | None]]:
    """Yields the names that a statement assigns, with the value; `None` if the value is unknown."""
    if isinstance(node, ast.Assign):
        targets, value = node.targets, node.value
    elif isinstance(node, ast.AnnAssign) and node.value is not None:
        targets, value = [node.target], node.value
    elif isinstance(node, ast.AugAssign | ast.For | ast.NamedExpr):
        targets, value = [node.target], None
    elif isinstance(node, ast.arg):
        yield node.arg, None
        return
    else:
        return
    for target in targets:
        for item in ast.walk(target):
            exact = value if item is target else None
            if isinstance(item, ast.Name) and isinstance(item.ctx, ast.Store):
                yield item.id, exact
            elif isinstance(item, ast.Attribute) and isinstance(item.ctx, ast.Store):
                yield f".{item.attr}", exact
