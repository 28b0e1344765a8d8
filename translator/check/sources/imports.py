"""Imports that no file and no package has, and names that a module does not have."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from translator.check.sources.found import Found, Moment, found_at
from translator.check.sources.modules import ACTIONS, is_installed, runs_projects

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.check.sources.modules import Module, Modules
    from translator.check.sources.scopes import Imported, Scopes, Use


class Imports:
    """The imports of one source.

    Args:
        scopes: its scopes.
        modules: what it can import.
        has_project: whether the files of the project are known.
    """

    def __init__(self, scopes: Scopes, modules: Modules, *, has_project: bool) -> None:
        self._scopes = scopes
        self._modules = modules
        self._has_project = has_project
        # A folder that is added to the path, or a module that is made, may have anything.
        self._may_have_more = any(
            use.name == "sys" and use.attributes[:1] in {("path",), ("modules",), ("meta_path",)}
            for use in scopes.uses
        )

    def findings(self) -> Iterator[Found]:
        """Yields what is wrong with the imports, and with the attributes of imported modules."""
        for imported in self._scopes.imports:
            if not imported.is_tried and imported.moment is not Moment.NEVER:
                yield from self._of_import(imported)
        yield from self._of_attributes()

    def _of_import(self, imported: Imported) -> Iterator[Found]:
        node = imported.node
        moment = Moment.LATER if imported.is_inner or self._may_have_more else imported.moment
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield from self._missing(node, alias.name, moment)
            return
        base = _base_of(node)
        if base is None:
            yield found_at("BT0642", node, moment, module="." * node.level + (node.module or ""))
            return
        missing = list(self._missing(node, base, moment))
        yield from missing
        if base == ACTIONS:
            for alias in node.names:
                yield from self._missing(node, f"{ACTIONS}.{alias.name}", moment)
        elif not missing:
            module = self._modules.find(base)
            for alias in node.names:
                if alias.name != "*" and module is not None and not _has(module, alias.name):
                    yield found_at("BT0643", node, moment, module=base, name=alias.name)

    def _missing(self, node: ast.AST, name: str, moment: Moment) -> Iterator[Found]:
        """Yields a finding if there is no module of a full name."""
        top, _, rest = name.partition(".")
        if top == ACTIONS:
            child = rest.partition(".")[0]
            if child and child != "*" and self._has_project and not self._modules.has_action(child):
                yield found_at("BT0621", node, moment, name=child)
            return
        if self._modules.is_own(top):
            return
        if is_installed(top):
            above = name.rpartition(".")[0]
            found = self._modules.find(above) if above else None
            last = name.rpartition(".")[2]
            if found is not None and found.folder is not None and not _has(found, last):
                yield found_at("BT0642", node, moment, module=name)
        elif self._modules.is_listed(name):
            if runs_projects() and moment is not Moment.LATER:
                yield found_at("BT0644", node, Moment.LATER, module=top)
        elif self._has_project:
            is_sure = runs_projects() and not self._modules.has_requirements
            yield found_at("BT0642", node, moment if is_sure else Moment.LATER, module=top)

    def _of_attributes(self) -> Iterator[Found]:
        told: set[tuple[str, str]] = set()
        if any(use.name in {"hasattr", "setattr"} for use in self._scopes.uses):
            return
        for use in self._scopes.uses:
            found = self._attribute(use) if use.attributes else None
            if found is not None and found not in told:
                told.add(found)
                yield found_at("BT0643", use.node, use.moment, module=found[0], name=found[1])

    def _attribute(self, use: Use) -> tuple[str, str] | None:
        """Returns the module or enumeration and the attribute that it does not have, or None."""
        name, attributes = self._module_of(use), list(use.attributes)
        above, _, last = name.rpartition(".")
        module = self._modules.find(name) if name else None
        if module is None and above:  # a class that is imported by its name
            name, attributes = above, [last, *attributes]
            module = self._modules.find(above)
        while module is not None and attributes:
            attribute = attributes.pop(0)
            if not _has(module, attribute):
                return name, attribute
            members = module.names.enums.get(attribute) if module.names is not None else None
            name = f"{name}.{attribute}"
            if members is not None and attributes and not _is_member(attributes[0], members):
                return name, attributes[0]
            module = module.child(attribute)
        return None

    def _module_of(self, use: Use) -> str:
        """Returns the full name of the module that a name stands for, or ""."""
        if not self._scopes.is_global(use):
            return ""
        names: set[str] = set()
        for binding in self._scopes.bindings.get(use.name, ()):
            node = binding.statement
            if isinstance(node, ast.Import):
                names.update(
                    alias.name if alias.asname else use.name
                    for alias in node.names
                    if (alias.asname or alias.name.partition(".")[0]) == use.name
                )
            elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                names.update(
                    f"{node.module}.{alias.name}"
                    for alias in node.names
                    if (alias.asname or alias.name) == use.name
                )
            else:
                return ""
        return names.pop() if len(names) == 1 else ""


def _base_of(node: ast.ImportFrom) -> str | None:
    """Returns the full name of the module that names are imported from; None if there is none above."""
    if node.level == 0:
        return node.module or ""
    if node.level > 1:
        return None
    return f"{ACTIONS}.{node.module}" if node.module else ACTIONS


def _has(module: Module, name: str) -> bool:
    """Returns whether a module may have a name."""
    names = module.names
    return names is None or name in names.names or module.has_child(name)


def _is_member(name: str, members: frozenset[str]) -> bool:
    """Returns whether an enumeration has a name; every one has those of `Enum`."""
    return name in members or name.startswith("_") or name in {"mro", "name", "value"}
