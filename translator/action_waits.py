"""Calls that wait in `update` or `initialise` of an action, read from its syntax tree without running it.

They stop the world in an exact run, whose time waits for the tree. Methods of the class and functions of the
module that the two call are read too. What other modules do is not seen.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["WaitingCall", "dotted_name", "imported_names", "waiting_calls"]

METHODS: Final = ("update", "initialise")
CALLS: Final = frozenset(
    {
        "time.sleep",
        "rclpy.spin",
        "rclpy.spin_once",
        "rclpy.spin_until_future_complete",
        "rclpy.wait_for_message.wait_for_message",
        "os.system",
        "os.popen",
        "urllib.request.urlopen",
    }
)
MODULES: Final = ("subprocess", "socket", "threading", "multiprocessing", "concurrent.futures", "requests")
"""Modules of which each function or class that is called waits, or works beside the tree."""
HARMLESS: Final = frozenset(
    {"threading.Lock", "threading.RLock", "threading.current_thread", "socket.gethostname"}
)
METHOD_NAMES: Final = frozenset(
    {"spin_once", "spin_until_future_complete", "wait_for_message", "wait_for_server", "wait_for_service"}
)
"""Methods that wait, of whatever object: executors, clients, action clients."""


@dataclass(frozen=True, slots=True)
class WaitingCall:
    """A call that waits: its name as the source's imports give it, and where it is."""

    name: str
    method: str
    line: int


def waiting_calls(source: str, name: str) -> list[WaitingCall]:
    """Returns the calls of the class `name` that wait, in the order of their lines."""
    try:
        module = parse(source, f"{name}.py")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    found = next((n for n in module.body if isinstance(n, ast.ClassDef) and n.name == name), None)
    if found is None:
        return []
    names = imported_names(module)
    methods, functions = _functions(found), _functions(module)
    calls: dict[int, WaitingCall] = {}
    for method in METHODS:
        waiting = [methods[method]] if method in methods else []
        seen = set(map(id, waiting))
        while waiting:
            for call in _calls(waiting.pop()):
                dotted = dotted_name(call.func, names)
                if _waits(dotted):
                    calls.setdefault(call.lineno, WaitingCall(dotted, method, call.lineno))
                own = methods.get(dotted.removeprefix("self.")) if dotted.startswith("self.") else None
                follows = own or functions.get(dotted)
                if follows is not None and id(follows) not in seen:
                    seen.add(id(follows))
                    waiting.append(follows)
    return [calls[line] for line in sorted(calls)]


def _waits(dotted: str) -> bool:
    if dotted in HARMLESS:
        return False
    if dotted in CALLS or any(dotted.startswith(f"{module}.") for module in MODULES):
        return True
    owner, _, method = dotted.rpartition(".")
    return bool(owner) and method in METHOD_NAMES


def _functions(scope: ast.Module | ast.ClassDef) -> dict[str, ast.FunctionDef | ast.AsyncFunctionDef]:
    return {n.name: n for n in scope.body if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef)}


def _calls(function: ast.AST) -> list[ast.Call]:
    return [node for node in ast.walk(function) if isinstance(node, ast.Call)]


def imported_names(module: ast.Module) -> dict[str, str]:
    """Returns what each imported name means, wherever it is imported."""
    names: dict[str, str] = {}
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            for alias in node.names:
                first = alias.name.partition(".")[0]
                names[alias.asname or first] = alias.name if alias.asname else first
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            for alias in node.names:
                names[alias.asname or alias.name] = f"{node.module}.{alias.name}"
    return names


def dotted_name(node: ast.expr, names: Mapping[str, str]) -> str:
    """Returns a called name with its module, as in `time.sleep`; "?.x" for a method of an expression."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    parts.append(names.get(node.id, node.id) if isinstance(node, ast.Name) else "?")
    return ".".join(reversed(parts))
