"""The files in `actions/` that actions import: modules without a class of their name, and other actions."""

from __future__ import annotations

import ast
import contextlib
from dataclasses import dataclass
from functools import lru_cache
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Final

from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from translator.project import Project

PACKAGE: Final = "actions"


@dataclass(frozen=True)
class Wanted:
    """A file of `actions/` that a source imports.

    Attributes:
        name: the name of the module.
        line: the line of the import.
    """

    name: str
    line: int


@dataclass(frozen=True)
class SharedModule:
    """A file of `actions/` that is run because others import it."""

    name: str
    path: str
    source: str


@lru_cache(maxsize=512)
def imports_of(source: str) -> tuple[Wanted, ...]:
    """Returns what a source imports from `actions/`, also by bare names; nothing if it cannot be read."""
    try:
        module = parse(source, "<action>")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    return tuple(found for node in ast.walk(module) for found in _wanted(node))


def _wanted(node: ast.AST) -> Iterator[Wanted]:
    if isinstance(node, ast.Import):
        for alias in node.names:
            yield from _named(alias.name, node.lineno)
    elif isinstance(node, ast.ImportFrom) and node.level <= 1:
        inside = f"{PACKAGE}." if node.level else ""
        if node.module and inside + node.module != PACKAGE:
            yield from _named(inside + node.module, node.lineno)
        else:
            for alias in node.names:
                if alias.name != "*":
                    yield Wanted(alias.name, node.lineno)


def _named(name: str, line: int) -> Iterator[Wanted]:
    first, _, rest = name.partition(".")
    if first != PACKAGE:
        yield Wanted(first, line)
    elif rest:
        yield Wanted(rest.partition(".")[0], line)


def shared_modules(project: Project, used: Iterable[str]) -> list[SharedModule]:
    """Returns the files that some actions import, and those that these import, without the actions."""
    sources = _sources(project.files)
    actions = set(used)
    found: set[str] = set()
    waiting = sorted(actions)
    while waiting:
        _, source = sources.get(waiting.pop(), ("", ""))
        for wanted in imports_of(source):
            if wanted.name in sources and wanted.name not in found | actions:
                found.add(wanted.name)
                waiting.append(wanted.name)
    return [SharedModule(name, *sources[name]) for name in sorted(found)]


def sources_of(project: Project) -> dict[str, str]:
    """Returns the sources of all files of `actions/` that are text, by the names of their modules."""
    return {name: source for name, (_, source) in _sources(project.files).items()}


def _sources(files: Mapping[str, bytes]) -> dict[str, tuple[str, str]]:
    found = {}
    for path in sorted(files):
        pure = PurePosixPath(path)
        is_here = pure.parts == (PACKAGE, pure.name) and pure.suffix == ".py"
        if is_here and pure.stem.isidentifier() and pure.stem != "__init__":
            with contextlib.suppress(UnicodeDecodeError):  # `load` reports it
                found[pure.stem] = (path, files[path].decode("utf-8-sig"))
    return found
