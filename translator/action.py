"""Reads the Python of an action without running it: class, docstring, ports, imports."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from translator.action_kind import (
    KINDS,
    LIMITS,
    children_of,
    is_loop,
    kind_by_bases,
    qualified_bases,
    without_effect,
)
from translator.action_ports import ATTRIBUTES as PORTS
from translator.action_ports import (
    Declarations,
    assigned,
    assignments,
    declared_ports,
    last_name,
    loop_ports,
    ports_used,
)
from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.limits import ACTION_BYTES, megabytes
from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.catalog import PortModel

KEPT_BYTES = 16 * 1024
"""The size in bytes above which a source is not cached, which limits the memory of the cache."""


@dataclass(frozen=True, slots=True)
class Import:
    """A module that an action imports, with the line of the import."""

    module: str
    line: int


@dataclass(frozen=True, slots=True)
class ActionModel:
    """An action, a control node or a decorator as its source declares it.

    If `open` is set, it accepts any port.
    """

    name: str
    doc: str = ""
    kind: str = "action"
    min_children: int = 0
    max_children: int | None = 0
    ports: tuple[PortModel, ...] = ()
    open: bool = True
    imports: tuple[Import, ...] = ()
    line: int = 1
    diagnostics: tuple[Diagnostic, ...] = ()
    source: str = field(default="", repr=False)
    path: str = ""

    def to_json(self) -> dict[str, Any]:
        """Returns the document that the editor and `--json` show."""
        return {
            "name": self.name,
            "path": self.path,
            "doc": self.doc,
            "kind": self.kind,
            "children": {"min": self.min_children, "max": self.max_children},
            "open": self.open,
            "line": self.line,
            "ports": [
                {
                    "name": port.name,
                    "direction": port.direction,
                    "type": port.type,
                    "default": port.default,
                    "required": port.required,
                    "description": port.description,
                }
                for port in self.ports
            ],
            "imports": list(dict.fromkeys(item.module for item in self.imports)),
            "diagnostics": [found.to_json() for found in self.diagnostics],
        }


def inspect_action(source: str, filename: str) -> ActionModel:
    """Reads the source of an action; returns a model for any source, with diagnostics."""
    # A project is read again after each save, and mostly one of its files has changed.
    return (_inspected if len(source) <= KEPT_BYTES else _inspect)(source, filename)


def _inspect(source: str, filename: str) -> ActionModel:
    name = PurePosixPath(filename).stem
    broken = ActionModel(name=name, source=source, path=filename)
    if len(source) > ACTION_BYTES:
        size, limit = megabytes(len(source)), megabytes(ACTION_BYTES)
        return _with(broken, diagnostic("BT0003", Place(filename, line=1), size=size, limit=limit))
    try:
        module = parse(source, filename)
    except SyntaxError as error:
        place = Place(filename, line=error.lineno or 1, column=error.offset or 1)
        return _with(broken, diagnostic("BT0601", place, problem=error.msg))
    except (ValueError, RecursionError, MemoryError) as error:
        problem = str(error) or "it is nested too deeply"
        return _with(broken, diagnostic("BT0601", Place(filename, line=1), problem=problem))
    try:
        return _Inspector(module, source, filename, name).model()
    except RecursionError:
        place = Place(filename, line=1)
        return _with(broken, diagnostic("BT0601", place, problem="it is nested too deeply"))


_inspected = lru_cache(maxsize=1024)(_inspect)


def _with(model: ActionModel, found: Diagnostic) -> ActionModel:
    return ActionModel(name=model.name, source=model.source, path=model.path, diagnostics=(found,))


def source_text(source: str) -> str:
    """Returns a source as XML can hold it: only line feeds end its lines, form feeds are removed."""
    return source.replace("\r\n", "\n").replace("\r", "\n").replace("\f", "")


class _Inspector:
    """Finds the class of a module that has the name of its file."""

    def __init__(self, module: ast.Module, source: str, filename: str, name: str) -> None:
        self.module = module
        self.source = source
        self.filename = filename
        self.name = name
        self.found: list[Diagnostic] = []
        self.classes = {node.name: node for node in module.body if isinstance(node, ast.ClassDef)}

    def report(self, code: str, node: ast.AST, **values: object) -> None:
        place = Place(
            self.filename,
            port=str(values.get("port", "")),
            line=getattr(node, "lineno", 1),
            column=getattr(node, "col_offset", 0) + 1,
        )
        self.found.append(diagnostic(code, place, **values))

    def model(self) -> ActionModel:
        imports = tuple(_imports(self.module))
        cls = self.classes.get(self.name)
        if cls is None:
            others = ", ".join(self.classes) or "none"
            code = "BT0602" if self.is_local() else "BT0607"
            self.report(code, self.module, name=self.name, classes=others)
            return self.result(imports=imports)
        lineage = self.lineage(cls)
        bases = qualified_bases(self.module, lineage)
        by_bases, base = kind_by_bases(bases)
        kind = self.kind(lineage, by_bases, base)
        loops = is_loop(bases)
        if not self.is_behaviour(cls):
            self.report("BT0603", cls, name=self.name)
        elif not loops and not self.has_update(cls):
            self.report("BT0604", cls, name=self.name)
        self.twice(lineage)
        if loops:
            without_effect(lineage, self.report)
        declarations = Declarations.collect(lineage)
        ports = loop_ports(lineage) if loops else declared_ports(declarations, self.report)
        is_open = not loops and not declarations.any
        least, most = children_of(lineage, kind, base, self.report)
        return self.result(
            doc=ast.get_docstring(cls) or "",
            kind=kind,
            min_children=least,
            max_children=most,
            ports=ports_used(cls) if is_open else ports,
            open=is_open,
            imports=imports,
            line=cls.lineno,
        )

    def result(self, **values: Any) -> ActionModel:
        return ActionModel(
            name=self.name, source=self.source, path=self.filename, diagnostics=tuple(self.found), **values
        )

    def is_local(self) -> bool:
        """Returns whether no import or assignment of the module defines the name."""
        for node in self.module.body:
            if isinstance(node, ast.Import | ast.ImportFrom):
                if any((alias.asname or alias.name) == self.name for alias in node.names):
                    return False
            elif assigned(node, self.name) is not None:
                return False
        return True

    def lineage(self, cls: ast.ClassDef) -> list[ast.ClassDef]:
        """Returns the class and those of its bases that are in the same file, nearest first."""
        line: list[ast.ClassDef] = []
        stack = [cls]
        while stack:
            current = stack.pop()
            if current in line:
                continue
            line.append(current)
            stack.extend(
                self.classes[base.id]
                for base in reversed(current.bases)
                if isinstance(base, ast.Name) and base.id in self.classes
            )
        return line

    def is_behaviour(self, cls: ast.ClassDef) -> bool:
        """Returns whether a base of the class may be a behaviour; an imported base always may be one."""
        local = self.lineage(cls)
        foreign = [
            base
            for member in local
            for base in member.bases
            if not (isinstance(base, ast.Name) and (base.id in self.classes or base.id in _PLAIN_BASES))
        ]
        return bool(foreign)

    def has_update(self, cls: ast.ClassDef) -> bool:
        """Returns whether the class, or a base that is not py_trees' own, defines `update`."""
        for member in self.lineage(cls):
            for node in member.body:
                if isinstance(node, ast.FunctionDef) and node.name == "update":
                    return True
                if isinstance(node, ast.AsyncFunctionDef) and node.name == "update":
                    self.report("BT0605", node, name=self.name)
                    return True
            for base in member.bases:
                if isinstance(base, ast.Name) and base.id in self.classes:
                    continue
                if last_name(base) not in _BASES_WITHOUT_UPDATE:
                    return True
        return False

    def kind(self, lineage: list[ast.ClassDef], by_bases: str, base: str) -> str:
        """Returns the kind that NODE_KIND names, unless the known `base` is of another kind."""
        found = assignments(lineage, "NODE_KIND")
        if not found:
            return by_bases
        node, value = found[-1]
        if not isinstance(value, ast.Constant):
            self.report("BT0647", node, kinds=", ".join(KINDS))
            return by_bases
        if value.value not in KINDS:
            self.report("BT0606", node, kinds=", ".join(KINDS))
            return by_bases
        kind = KINDS[value.value]
        if base and (kind in LIMITS or by_bases in LIMITS) and kind != by_bases:
            self.report("BT0618", node, kind=value.value, base=base)
            return by_bases
        return kind

    def twice(self, lineage: list[ast.ClassDef]) -> None:
        """Reports attributes for the engine that a class assigns more than once."""
        for name in (*PORTS, "NODE_KIND", "MIN_CHILDREN", "MAX_CHILDREN", "RETURNS", "ELEMENT"):
            found = assignments(lineage, name)
            if len(found) > 1:
                self.report("BT0648", found[0][0], attribute=name, line=found[-1][0].lineno)


_BASES_WITHOUT_UPDATE = {
    *("Behaviour", "PortsMixin", "ABC", "BehaviourWithPorts", "ControlNode", "DecoratorNode"),
}
_PLAIN_BASES = {"object", "Exception", "ABC", "Protocol", "Enum", "dict", "list", "str", "int", "float"}


def _imports(module: ast.Module) -> Iterator[Import]:
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield Import(alias.name, node.lineno)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield Import(node.module, node.lineno)
