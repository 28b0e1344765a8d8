"""Finds out which actions changed, and undoes the loading of actions.

An action changed if its source changed, or that of an action that it imports.
"""

import ast
import linecache
import sys
from collections.abc import Callable, Mapping

from tree_gardener.actions import PACKAGE


def unchanged(before: Mapping[str, str], after: Mapping[str, str]) -> frozenset[str]:
    """Returns the names of the sources that are the same, and import none that changed.

    Args:
        before: the sources by name, as `load_actions` takes them.
        after: the same later. A source that Python cannot read counts as one without imports.
    """
    same = {name for name, source in after.items() if before.get(name) == source}
    known = before.keys() | after.keys()
    imports = {name: _imported(source) & known for name, source in after.items()}
    while True:
        stay = {name for name in same if imports[name] <= same}
        if stay == same:
            return frozenset(same)
        same = stay


def remember_actions() -> Callable[[], None]:
    """Returns a function that undoes each `load_actions` since this call, with its modules and lines."""
    finders = list(sys.meta_path)
    modules = {name: module for name, module in sys.modules.items() if _is_action(name)}
    lines = {name: entry for name, entry in linecache.cache.items() if name.startswith(f"{PACKAGE}/")}

    def undo() -> None:
        for name in [name for name in sys.modules if _is_action(name)]:
            del sys.modules[name]
        sys.modules.update(modules)
        sys.meta_path[:] = finders
        linecache.cache.update(lines)

    return undo


def _is_action(name: str) -> bool:
    module = sys.modules.get(name)
    own = getattr(module, "__name__", "")
    return own == PACKAGE or own.startswith(f"{PACKAGE}.")


def _imported(source: str) -> set[str]:
    """Returns the names of actions that a source may import, by any of the ways to write it."""
    try:
        module = ast.parse(source)
    except (SyntaxError, ValueError):
        return set()
    found: set[str] = set()
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            found |= {_action(alias.name) for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            origin = node.module or ""
            if origin in ("", PACKAGE):
                found |= {alias.name for alias in node.names}
            else:
                found.add(_action(origin))
    return found


def _action(module: str) -> str:
    return module.removeprefix(f"{PACKAGE}.").partition(".")[0]
