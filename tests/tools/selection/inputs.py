"""The inputs of each test file: modules that it imports, modules that its processes load, and data by rules.

Everything that a rule does not know counts for every test, so that nothing is missed by a gap of a rule.
"""

from __future__ import annotations

import sys
from functools import cached_property
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Final

import grimp

from tests.tools.selection import sources
from tests.tools.selection.reach import Reach, Reached
from tests.tools.selection.rules import EVERYTHING, NAMED, NOT_FOLLOWED, READ_AS_TEXTS, ROWS, Row, row_of
from tests.tools.selection.table import ROOT, Executed
from tests.tools.selection.tree import digest
from tests.tools.selection.units import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping

    from tests.tools.selection.units import Module

PACKAGES: Final = ("backend", "executor", "translator", "tree_gardener", "tests")
# Python files below are read as text, as users' files are; nobody imports them.
TEXTS: Final = ("backend/catalog/behaviours/", "examples/")


class Inputs:
    """The inputs of the test files of one tree."""

    def __init__(
        self,
        tree: Mapping[str, str],
        imports: grimp.ImportGraph,
        loaded: Mapping[str, frozenset[str]],
        rows: tuple[Row, ...] = ROWS,
        *,
        executed: Mapping[str, Executed] | None = None,
        parts: Callable[[], Mapping[str, Module]] | None = None,
    ) -> None:
        self._executed = executed or {}
        self._parts = parts
        self._reached: dict[str, Reached] = {}
        self.tree = tree
        self._imports = imports
        self._loaded = loaded
        self._rows = rows
        self._closures: dict[str, frozenset[str]] = {}

    def of(self, file: str) -> frozenset[str]:
        """Returns the paths of all that the tests of a file can read."""
        if file.startswith(EVERYTHING):
            return frozenset(self.tree)
        modules = self.modules(file)
        data = {path for row, paths in self._data.items() if _is_read(row, modules) for path in paths}
        return frozenset(modules | data | self.unknown)

    def digest(self, file: str) -> str:
        """Returns a digest of all that the tests of a file can read, and of Python's version."""
        python = {"python": ".".join(map(str, sys.version_info[:3]))}
        reached = self.reached(file)
        if reached is None:
            return digest({path: self.tree[path] for path in self.of(file) if path in self.tree} | python)
        wholes = {path: self.tree[path] for path in self.wholes(file)}
        return digest(wholes | python | {"functions": reached.digest()})

    def reached(self, file: str) -> Reached | None:
        """Returns what counts of the modules for the tests of a file; none where imports stand for it."""
        if file not in self._executed or file.startswith((*EVERYTHING, *NOT_FOLLOWED)):
            return None
        if file not in self._reached:
            self._reached[file] = self.reach(file, self._executed[file])
        return self._reached[file]

    def reach(self, file: str, executed: Executed, kept: Iterable[tuple[str, str]] = ()) -> Reached:
        """Returns what counts where the tests of a file run some functions, and those kept that are named."""
        own = self._imported({file, *self._conftests(file)})
        processes = {*executed.modules, *(path for path, _ in executed.functions)}
        modules = own | self._loaded_with(processes)
        return self.whole_reach.of(executed.functions, kept, frozenset(modules), file)

    def wholes(self, file: str) -> frozenset[str]:
        """Returns the paths that count as a whole for a file whose functions are known: data, and texts."""
        executed, reached = self._executed[file], self.reached(file)
        ran = {path for path, _ in executed.functions} | {file}
        # A module of which nothing counts has read nothing that could matter.
        readers = (
            frozenset(path for path, unit in reached.units if unit.kind is not Kind.DOC) if reached else ()
        )
        texts = {
            path
            for reader, read in READ_AS_TEXTS
            if any(each.startswith(reader) for each in ran)
            for path in self.tree
            if path.startswith(read)
        }
        data = {path for row, paths in self._data.items() if _is_read(row, readers) for path in paths}
        every = {*data, *texts, *executed.texts, *self.unknown}
        return frozenset(path for path in every if path in self.tree)

    @cached_property
    def whole_reach(self) -> Reach:
        """The units of all modules of the tree."""
        return Reach(self.parts)

    @cached_property
    def parts(self) -> Mapping[str, Module]:
        """The modules of the tree, taken apart."""
        if self._parts:
            return self._parts()
        return sources.modules(self.tree, [path for path in self.tree if self.is_module(path)])

    def _loaded_with(self, paths: Iterable[str]) -> set[str]:
        """Returns modules, and those that their import statements outside of functions load."""
        found, waiting = set[str](), [path for path in paths if path in self.parts]
        while waiting:
            path = waiting.pop()
            if path not in found:
                found.add(path)
                waiting += [each for each in self.parts[path].imports if each in self.parts]
        return found

    def modules(self, file: str) -> frozenset[str]:
        """Returns the modules that the tests of a file or their processes load, as paths."""
        return self._imported({file, *self._conftests(file), *self._loaded.get(file, ())})

    def _imported(self, found: set[str]) -> frozenset[str]:
        paths = set(found)
        for each in found:
            paths |= self._closure(each)
        for reader, named in NAMED:
            if any(path.startswith(reader) for path in paths):
                paths |= self._closure_of_all(named)
        return frozenset(paths)

    @cached_property
    def unknown(self) -> frozenset[str]:
        """The paths that no rule knows: every test can read them."""
        return frozenset(path for path in self.tree if not self.is_module(path) and self._row(path) is None)

    @cached_property
    def _data(self) -> dict[Row, list[str]]:
        found: dict[Row, list[str]] = {}
        for path in self.tree:
            if not self.is_module(path) and (row := self._row(path)):
                found.setdefault(row, []).append(path)
        return found

    def _row(self, path: str) -> Row | None:
        return row_of(path, self._rows)

    @staticmethod
    def is_module(path: str) -> bool:
        """Returns whether a path is a module that code can import."""
        return (
            path.endswith(".py") and path.split("/", maxsplit=1)[0] in PACKAGES and not path.startswith(TEXTS)
        )

    def _conftests(self, file: str) -> Iterable[str]:
        above = (f"{folder}/conftest.py" for folder in PurePosixPath(file).parents)
        return [path for path in above if path in self.tree]

    def _closure(self, path: str) -> frozenset[str]:
        """Returns a module, the modules that it imports, and those that these import."""
        if path not in self._closures:
            name = _module(path)
            reached = self._imports.find_upstream_modules(name) if name in self._imports.modules else set()
            self._closures[path] = frozenset(
                found for each in {name, *reached} for found in self._paths(each) if found in self.tree
            )
        return self._closures[path]

    def _closure_of_all(self, folder: str) -> frozenset[str]:
        key = f"{folder}*"
        if key not in self._closures:
            paths = [path for path in self.tree if path.startswith(folder) and self.is_module(path)]
            self._closures[key] = frozenset(paths).union(*map(self._closure, paths))
        return self._closures[key]

    @staticmethod
    def _paths(module: str) -> Iterable[str]:
        path = module.replace(".", "/")
        yield f"{path}.py"
        while path:  # importing a module runs the packages above it
            yield f"{path}/__init__.py"
            path = path.rpartition("/")[0]


def _module(path: str) -> str:
    return path.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def _is_read(row: Row, modules: Collection[str]) -> bool:
    return any(path.startswith(row.readers) for path in modules) if row.readers else False


def import_graph() -> grimp.ImportGraph:
    """Returns the imports of the working tree, those in functions and for types included."""
    cache = ROOT / "var" / "grimp"
    return grimp.build_graph(*PACKAGES, include_external_packages=False, cache_dir=str(cache))
