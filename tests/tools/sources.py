"""Reads what Python sources import, once a process for all checks that go through every source."""

from __future__ import annotations

import ast
import functools
from typing import NamedTuple


class Import(NamedTuple):
    """An import of a whole module, or of names of a module."""

    module: str
    names: frozenset[str] | None = None


@functools.cache
def imports_of(source: str) -> frozenset[Import]:
    """Returns the absolute imports anywhere in a source."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {Import(alias.name) for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            found.add(Import(node.module, frozenset(alias.name for alias in node.names)))
    return frozenset(found)
