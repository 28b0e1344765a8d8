"""Packages whose names are imported when they are asked for, so that who needs one does not load all."""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["import_names", "lazy_package"]


def lazy_package(package: str, origins: Mapping[str, str]) -> None:
    """Makes a package import the names of its modules when they are asked for.

    A submodule does not hide a name that is the same as its own, such as the function `translator.check`.

    Args:
        package: the package, within whose `__init__` this is called.
        origins: the names, with spaces between them, by the modules that have them.
    """
    found = sys.modules[package]
    names = {name: _name(module, name) for module, each in origins.items() for name in each.split()}
    found.__class__ = type("LazyPackage", (_LazyPackage,), names)


def import_names(package: ModuleType) -> None:
    """Imports all names of a package, for a process that cannot do so later or should not wait then."""
    for name in package.__all__:
        getattr(package, name)


class _LazyPackage(ModuleType):
    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.__all__})


def _name(module: str, name: str) -> property:
    """Returns an attribute that is imported at its first use."""

    def get(package: ModuleType) -> Any:
        known = package.__dict__
        if name not in known:
            known[name] = getattr(import_module(module), name)
        return known[name]

    def put(package: ModuleType, value: object) -> None:
        is_submodule = isinstance(value, ModuleType) and value.__name__ == f"{package.__name__}.{name}"
        if not is_submodule:  # the import system sets these
            package.__dict__[name] = value

    return property(get, put)
