"""A copy of rclpy with the return types that its sources leave out.

A language server infers the type of a call's result from the declared return type. The functions of rclpy
that actions call most often declare none, so there would be no completions after `node.get_logger().`.
"""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

PACKAGE: Final = "rclpy"
_GOAL: Final = {
    "ClientGoalHandle.accepted": "bool",
    "ClientGoalHandle.status": "int",
    "ClientGoalHandle.cancel_goal_async": "Future",
    "ClientGoalHandle.get_result_async": "Future",
    "ActionClient.send_goal_async": "Future",
    "ActionClient.server_is_ready": "bool",
    "ActionClient.wait_for_server": "bool",
}
RETURNED: Final[Mapping[str, Mapping[str, str]]] = {
    "node.py": {"Node.get_logger": "RcutilsLogger"},
    "action/client.py": _GOAL,
    "task.py": {"Future.cancelled": "bool", "Future.done": "bool"},
    "timer.py": {"Timer.is_canceled": "bool", "Timer.is_ready": "bool"},
}
"""The return types of methods, by file and method; they were found in the sources and their callers."""
_IMPORTS: Final = {
    "Future": "from rclpy.task import Future\n",
    "RcutilsLogger": "from rclpy.impl.rcutils_logger import RcutilsLogger\n",
}
_END_OF_SIGNATURE: Final = re.compile(r"\)\s*:")


def write_annotated(site_packages: Path, folder: Path) -> None:
    """Writes the Python sources of rclpy with return types to a folder.

    Does nothing if rclpy is not installed.
    """
    source = site_packages / PACKAGE
    for path in sorted(source.rglob("*.py")):
        name = path.relative_to(source).as_posix()
        target = folder / PACKAGE / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(
            annotated(path.read_text(encoding="utf-8"), RETURNED.get(name, {})), encoding="utf-8"
        )


def annotated(source: str, returned: Mapping[str, str]) -> str:
    """Returns the source with these return types; methods that declare a return type keep it."""
    lines = source.splitlines(keepends=True)
    names = set()
    for method in _methods(source):
        if (returns := returned.get(method.name)) is None:
            continue
        signature = "".join(lines[method.first : method.body])
        ends = list(_END_OF_SIGNATURE.finditer(signature))
        if ends:
            cut = ends[-1].start()
            lines[method.first] = f'{signature[:cut]}) -> "{returns}"{signature[cut + 1 :]}'
            lines[method.first + 1 : method.body] = [""] * (method.body - method.first - 1)
            names.add(returns)
    return "".join(lines) + "".join(_IMPORTS[name] for name in sorted(names) if name in _IMPORTS)


class _Method:
    def __init__(self, owner: ast.ClassDef, function: ast.FunctionDef) -> None:
        self.name = f"{owner.name}.{function.name}"
        self.first = function.lineno - 1
        self.body = max(function.body[0].lineno - 1, function.lineno)


def _methods(source: str) -> list[_Method]:
    """Returns the methods without a return type."""
    return [
        _Method(owner, function)
        for owner in ast.parse(source).body
        if isinstance(owner, ast.ClassDef)
        for function in owner.body
        if isinstance(function, ast.FunctionDef) and function.returns is None
    ]
