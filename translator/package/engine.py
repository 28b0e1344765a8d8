"""The files of the engine, for exported packages and apps."""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from importlib.resources.abc import Traversable

_LEFT_OUT = {"__pycache__", "conformance"}
_KEPT = (".py", ".json", ".typed")


@cache
def engine_files() -> Mapping[str, bytes]:
    """Returns the files of the package `tree_gardener`, by path from the folder that holds it."""
    found: dict[str, bytes] = {}
    stack: list[tuple[str, Traversable]] = [("tree_gardener", resources.files("tree_gardener"))]
    while stack:
        path, item = stack.pop()
        if item.is_dir():
            if item.name not in _LEFT_OUT:
                stack.extend((f"{path}/{child.name}", child) for child in item.iterdir())
        elif item.name.endswith(_KEPT):
            found[path] = item.read_bytes()
    return dict(sorted(found.items()))
