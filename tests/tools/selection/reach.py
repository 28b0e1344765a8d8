"""Which units of the modules count for a test: what its functions use, by name, and what it loads.

A function that did not run does not count, nor does what no code of the test names: no name can then be
resolved in another way. A name alone is one of its own module. An attribute, or a text, may mean what has
this name in any module, so that more counts than is used.
"""

from __future__ import annotations

import hashlib
from collections import defaultdict
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from tests.tools.selection.units import DOCS, INERT_BASES, OWN_DOCS, Kind, Module, Unit

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

Function = tuple[str, str]
"""A path and the name of a function with that of its class."""
# Django finds all names of these modules, and of migrations.
BY_CONVENTION: Final = ("/settings.py", "/apps.py")
_HOOKS: Final = "pytest"


@dataclass
class Reached:
    """The parts that count for a test: units by path, functions that ran, and names that its code uses."""

    units: set[tuple[str, Unit]] = field(default_factory=set)
    ran: set[Function] = field(default_factory=set)
    gone: set[Function] = field(default_factory=set)
    names: set[tuple[str, str]] = field(default_factory=set)
    """Each with the module whose code uses it; an empty one stands for all modules."""
    modules: frozenset[str] = frozenset()
    beginnings: set[str] = field(default_factory=set)
    documented: set[str] = field(default_factory=set)
    """The modules whose docstrings are read; an empty text stands for all."""

    def uses(self, path: str, name: str) -> bool:
        """Returns whether code of the test uses a name of a module, or asks for names that begin like it."""
        return bool(self.names & {("", name), (path, name)}) or name.startswith(tuple(self.beginnings))

    def digest_of(self, path: str, unit: Unit) -> str:
        """Returns the digest of a unit as it counts here."""
        return unit.digest_with_docs if self.documented & {"", path} else unit.digest

    def digest(self) -> str:
        """Returns a digest of all that counts."""
        lines = sorted(
            f"{path}\0{unit.kind}\0{unit.qualified}\0{self.digest_of(path, unit)}"
            for path, unit in self.units
            if unit.kind is not Kind.DOC or self.documented & {"", path}
        )
        lines += sorted(f"{path}\0gone\0{name}" for path, name in self.gone)
        return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]


class Reach:
    """Finds what counts, in the modules of one tree."""

    def __init__(self, modules: Mapping[str, Module]) -> None:
        self._modules = modules
        self._named: defaultdict[str, list[tuple[str, Unit]]] = defaultdict(list)
        self._named_in: defaultdict[Function, list[Unit]] = defaultdict(list)
        self._methods: defaultdict[tuple[str, str], list[Unit]] = defaultdict(list)
        self._methods_by_name: defaultdict[str, list[tuple[str, Unit]]] = defaultdict(list)
        self._bodies: defaultdict[Function, list[Unit]] = defaultdict(list)
        self._classes: dict[Function, Unit] = {}
        self._known: defaultdict[str, list[tuple[frozenset[str], tuple[str, ...]]]] = defaultdict(list)
        for path, module in modules.items():
            for unit in module.units:
                self._index(path, unit)
        for (path, name), unit in self._classes.items():
            methods = frozenset(each.name for each in self._methods[path, name])
            self._known[unit.name].append((methods, unit.bases))
        self._always = {
            path: [unit for unit in module.units if self._always_counts(path, unit)]
            for path, module in modules.items()
        }

    def _index(self, path: str, unit: Unit) -> None:
        if unit.kind is Kind.BODY:
            self._bodies[path, unit.qualified].append(unit)
        elif unit.owner and not unit.is_class:
            self._methods[path, unit.owner].append(unit)
            self._methods_by_name[unit.name].append((path, unit))
        elif unit.kind is Kind.NAME:
            self._named[unit.name].append((path, unit))
            self._named_in[path, unit.name].append(unit)
            if unit.is_class:
                self._classes[path, unit.qualified] = unit

    def bodies(self, function: Function) -> list[Unit]:
        """Returns the bodies of a function."""
        return self._bodies.get(function, [])

    def methods(self, path: str, owner: str) -> list[Unit]:
        """Returns the signatures of the methods of a class."""
        return self._methods.get((path, owner), [])

    def named(self, name: str) -> list[tuple[str, Unit]]:
        """Returns what has a name in its module, with the path."""
        return self._named.get(name, [])

    def named_in(self, path: str, name: str) -> list[Unit]:
        """Returns what has a name in one module."""
        return self._named_in.get((path, name), [])

    def methods_named(self, name: str) -> Iterator[tuple[str, Unit, Unit]]:
        """Returns the methods with a name, each with its path and its class."""
        for path, method in self._methods_by_name.get(name, ()):
            yield path, method, self._classes[path, method.owner]

    def names_with(self, beginning: str) -> Iterator[str]:
        """Returns the names that begin with a text."""
        for name in (*self._named, *self._methods_by_name):
            if name.startswith(beginning):
                yield name

    def inherited(self, bases: Iterable[str]) -> frozenset[str] | None:
        """Returns the names of the methods that bases have; none if one of them is not known."""
        found, waiting, seen = set[str](), list(bases), set[str]()
        while waiting:
            base = waiting.pop()
            if base in seen:
                continue
            seen.add(base)
            if base in self._known:
                for methods, above in self._known[base]:
                    if "__init_subclass__" in methods:
                        return None
                    found |= methods
                    waiting += above
            elif base in INERT_BASES:
                found |= set(INERT_BASES[base].split())
            else:
                return None
        return frozenset(found)

    def of(
        self, ran: Iterable[Function], kept: Iterable[Function], modules: frozenset[str], test: str
    ) -> Reached:
        """Returns what counts for a test.

        Args:
            ran: the functions that ran in it.
            kept: those that ran before it, and count where it names them.
            modules: the paths of the modules that it loads.
            test: the path of its own file, which counts as a whole.
        """
        search = _Search(self, kept, modules)
        for unit in self._modules[test].units if test in self._modules else ():
            search.include(test, unit)
        for path in modules:
            for unit in self._always.get(path, ()):
                search.include(path, unit)
        for function in ran:
            search.run(function)
        search.follow()
        return search.found

    def counts(self, reached: Reached, path: str, unit: Unit) -> bool:
        """Returns whether a unit, which may be one of another version of its module, counts for a test."""
        if unit.kind is Kind.BODY:
            return (path, unit.qualified) in reached.ran or (
                path in reached.modules and unit.name.startswith(_HOOKS)
            )
        if path not in reached.modules:
            return False
        if unit.kind is Kind.DOC:
            return bool(reached.documented & {"", path})
        if unit.kind is Kind.METHOD:
            owner = self._classes.get((path, unit.owner))
            if owner is None:
                return reached.uses(path, unit.owner.rpartition(".")[2])
            return (path, owner) in reached.units and self.is_called(reached, owner, unit)
        return self._always_counts(path, unit) or reached.uses(path, unit.name)

    def is_called(self, reached: Reached, owner: Unit, method: Unit) -> bool:
        """Returns whether something can call a method of a class that counts, as far as names show it."""
        inherited = self.inherited(owner.bases)
        is_special = method.name.startswith("__") and method.name.endswith("__")
        return is_special or inherited is None or method.name in inherited or reached.uses("", method.name)

    def _always_counts(self, path: str, unit: Unit) -> bool:
        if unit.name.startswith(_HOOKS) and unit.kind is not Kind.METHOD:
            return True
        if unit.kind is Kind.NAME:
            by_convention = path.endswith(BY_CONVENTION) or "/migrations/" in path
            return by_convention or (unit.is_class and self.inherited(unit.bases) is None)
        return unit.kind in (Kind.EFFECT, Kind.DOC)


class _Search:
    def __init__(self, reach: Reach, kept: Iterable[Function], modules: frozenset[str]) -> None:
        self.found = Reached(modules=modules)
        self._reach = reach
        self._waiting: list[tuple[str, str]] = []
        self._kept: defaultdict[str, list[Function]] = defaultdict(list)
        for path, name in kept:
            if path in modules:
                self._kept[name.rpartition(".")[2]].append((path, name))

    def run(self, function: Function) -> None:
        """Includes a function that ran, with its class."""
        path, _ = function
        if function in self.found.ran:
            return
        self.found.ran.add(function)
        bodies = self._reach.bodies(function)
        if not bodies:
            self.found.gone.add(function)
        for body in bodies:  # a property has several
            self.include(path, body)
            for unit in self._reach.methods(path, body.owner) if body.owner else ():
                if unit.name == body.name:
                    self.include(path, unit)
            self._use(path, body.owner.partition(".")[0] if body.owner else body.name)

    def include(self, path: str, unit: Unit) -> None:
        """Includes a unit with what it names."""
        if (path, unit) in self.found.units:
            return
        self.found.units.add((path, unit))
        for name in unit.names:
            self._use("" if name[0] == "." else path, name.removeprefix("."))
        if OWN_DOCS in unit.names:
            self.found.documented.add(path)
        if DOCS in unit.names:  # what stands outside of functions is said of the own module
            self.found.documented.add("" if unit.kind is Kind.BODY else path)
        if unit.is_class:
            self._include_methods(path, unit)

    def _include_methods(self, path: str, unit: Unit) -> None:
        for method in self._reach.methods(path, unit.qualified):
            if self._reach.is_called(self.found, unit, method):
                self.include(path, method)

    def _use(self, path: str, name: str) -> None:
        if (path, name) not in self.found.names:
            self.found.names.add((path, name))
            if name.endswith("*"):
                self.found.beginnings.add(name[:-1])
            self._waiting.append((path, name))

    def follow(self) -> None:
        """Includes what is named, until nothing is new."""
        while self._waiting:
            user, name = self._waiting.pop()
            if name.endswith("*"):
                for each in self._reach.names_with(name[:-1]):
                    self._use("", each)
            if user:
                for unit in self._reach.named_in(user, name):
                    self.include(user, unit)
            for path, unit in self._reach.named(name) if not user else ():
                if path in self.found.modules:
                    self.include(path, unit)
            for path, method, owner in self._reach.methods_named(name) if not user else ():
                if (path, owner) in self.found.units:
                    self.include(path, method)
            for path, function in self._kept.get(name, ()):
                if user in ("", path):
                    self.run((path, function))
