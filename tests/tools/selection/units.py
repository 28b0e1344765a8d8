"""Takes a module apart into what can change without the rest: units, each with a digest of its syntax tree.

Comments and form are in no digest. Docstrings are in a second one, for tests whose code reads docstrings.
A unit says which names it uses; what has one of these names can be reached from it.
"""

from __future__ import annotations

import ast
import builtins
import hashlib
import re
import struct
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Final

from tests.tools.measuring.executed import path_hash

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path


class Kind(StrEnum):
    """When a unit of a loaded module counts for a test."""

    EFFECT = "effect"
    """Always: its evaluation may do something elsewhere, as to register."""
    NAME = "name"
    """If it is named: an import, a constant, a class, the signature of a function."""
    METHOD = "method"
    """If its class counts, and something can call it: see `reach.py`. Its signature."""
    BODY = "body"
    """If the function ran."""
    DOC = "doc"
    """If docstrings are read: that of the module."""


@dataclass(frozen=True)
class Unit:
    """A part of a module; `owner` is the class of a method, `lines` are those of a function."""

    kind: Kind
    name: str
    digest: str
    digest_with_docs: str
    names: frozenset[str] = frozenset()
    owner: str = ""
    lines: tuple[int, int] = (0, 0)
    bases: tuple[str, ...] = ()
    is_class: bool = False

    @property
    def qualified(self) -> str:
        """Its name with that of its class."""
        return f"{self.owner}.{self.name}" if self.owner else self.name

    @property
    def key(self) -> tuple[str, str]:
        """Its identity, for the comparison of two versions of a module."""
        return (self.kind, self.qualified or self.digest)


@dataclass(frozen=True)
class Module:
    """The units of a module, and the modules that are loaded with it, as paths that there may be."""

    units: tuple[Unit, ...]
    imports: frozenset[str]

    def function_at(self, line: int) -> str | None:
        """Returns the outermost function at a line; none where the whole statement is one unit."""
        for unit in self.units:
            if unit.kind is Kind.BODY and unit.lines[0] <= line <= unit.lines[1]:
                return unit.qualified
        return None


DOCS: Final = ".__doc__"
"""The name that stands for the docstrings of anything."""
OWN_DOCS: Final = "__doc__"
"""The name that stands for those of the own module."""
HARMLESS_DECORATORS: Final = frozenset(
    {
        *("staticmethod", "classmethod", "property", "setter", "getter", "deleter", "overload", "override"),
        *("cache", "lru_cache", "cached_property", "contextmanager", "asynccontextmanager", "wraps", "final"),
        *("abstractmethod", "dataclass", "total_ordering", "runtime_checkable", "unique"),
    }
)
# Calls of these, of a class and of methods of texts change nothing elsewhere.
HARMLESS_CALLS: Final = frozenset(
    {
        *(name for name in dir(builtins) if name not in {"exec", "eval", "setattr", "open", "__import__"}),
        *("compile", "getLogger", "field", "namedtuple", "join", "split", "strip", "format", "encode"),
        *("decode", "items", "keys", "values", "fromkeys", "union", "lower", "upper", "removeprefix"),
        *("removesuffix", "replace", "with_name", "resolve", "read_text", "get", "partial", "attrgetter"),
        *("itemgetter", "escape", "dedent", "loads"),
    }
)
_FILLING: Final = frozenset({"setdefault", "append", "add", "update", "insert"})
CACHES: Final = frozenset({"cache", "lru_cache", "cached_property"})
# Bases that are not ours, and do nothing with their subclasses but what the second text names.
INERT_BASES: Final = {
    "object": "",
    "Protocol": "",
    "Generic": "",
    "ABC": "",
    "TypedDict": "",
    "NamedTuple": "",
    "Struct": "",
    "Enum": "_missing_ _generate_next_value_",
    "StrEnum": "_missing_ _generate_next_value_",
    "IntEnum": "_missing_ _generate_next_value_",
    "Flag": "_missing_ _generate_next_value_",
    "IntFlag": "_missing_ _generate_next_value_",
    "Thread": "run start join name daemon ident",
    **{
        name: "with_traceback add_note args"
        for name, each in vars(builtins).items()
        if isinstance(each, type) and issubclass(each, BaseException)
    },
}
_WORD: Final = re.compile(r"[A-Za-z_]\w*")
_NAMES_IN_TEXT: Final = re.compile(r"[\w.:/]{1,120}")


def names_of(node: ast.AST) -> frozenset[str]:
    """Returns the names that code uses: those of its module, and with a dot before them those of anything.

    A text may be asked for as an attribute, so that it is one of the latter.
    """
    return frozenset(_names(node))


def _names(node: ast.AST) -> Iterator[str]:
    alone = {id(each.value) for each in ast.walk(node) if isinstance(each, ast.Expr)}
    for each in ast.walk(node):
        if isinstance(each, ast.Name):
            yield each.id if each.id != "__doc__" else OWN_DOCS
        elif isinstance(each, ast.Attribute):
            yield f".{each.attr}" if each.attr not in ("__doc__", "getdoc") else DOCS
        elif isinstance(each, ast.Import | ast.ImportFrom):
            yield from imported_names(each)
        elif isinstance(each, ast.Constant) and isinstance(each.value, str) and id(each) not in alone:
            if _NAMES_IN_TEXT.fullmatch(each.value):
                yield from (f".{word}" for word in _WORD.findall(each.value))
        elif isinstance(each, ast.JoinedStr):
            # `getattr(self, f"_on_{kind}")` names all that begins so.
            first = each.values[0] if each.values else None
            if isinstance(first, ast.Constant) and re.fullmatch(r"[a-z_]+_", text := str(first.value)):
                yield f".{text}*"
        elif isinstance(each, ast.MatchClass):
            yield from (f".{name}" for name in each.kwd_attrs)


def imported_names(node: ast.Import | ast.ImportFrom) -> Iterator[str]:
    """Returns the names that an import asks other modules for."""
    for alias in node.names:
        yield from (f".{name}" for name in alias.name.split("."))
    if isinstance(node, ast.ImportFrom):
        yield from (f".{name}" for name in (node.module or "").split("."))


def module_of(source: str | bytes) -> Module:
    """Takes a module apart; a text that is no Python is one unit."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError):
        text = source if isinstance(source, str) else source.decode(errors="replace")
        return Module((Unit(Kind.EFFECT, "", _digest(text), _digest(text)),), frozenset())
    module = _Module(tree)
    return Module(tuple(module.units()), frozenset(module.imports()))


class _Module:
    def __init__(self, tree: ast.Module) -> None:
        self._body = tree.body

    def units(self) -> Iterator[Unit]:
        for statement in self._body:
            if isinstance(statement, ast.Import | ast.ImportFrom):
                yield from self._import(statement)
            elif isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef):
                yield from self._function(statement, "")
            elif isinstance(statement, ast.ClassDef):
                yield from self._class(statement, "")
            elif isinstance(statement, ast.Assign | ast.AnnAssign) and (names := _targets(statement)):
                kind = Kind.NAME if _is_harmless(statement) else Kind.EFFECT
                for name in names:
                    yield _unit(kind, name, [statement], names_of(statement))
            elif _is_docstring(statement):
                yield _unit(Kind.DOC, "__doc__", [statement])
            elif not _is_for_types(statement):
                yield _unit(Kind.EFFECT, "", [statement], names_of(statement))

    def imports(self) -> Iterator[str]:
        """Returns the paths of modules that the import statements outside of functions may load."""
        waiting: list[ast.AST] = list(self._body)
        while waiting:
            node = waiting.pop()
            if isinstance(node, ast.Import):
                for alias in node.names:
                    yield from _paths(alias.name)
            elif isinstance(node, ast.ImportFrom) and not node.level and node.module:
                for alias in node.names:
                    yield from _paths(f"{node.module}.{alias.name}")
                yield from _paths(node.module)
            elif not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and not _is_for_types(node):
                waiting += [each for each in ast.iter_child_nodes(node) if not isinstance(each, ast.expr)]

    @staticmethod
    def _import(statement: ast.Import | ast.ImportFrom) -> Iterator[Unit]:
        place = (
            "" if isinstance(statement, ast.Import) else f"{'.' * statement.level}{statement.module or ''}"
        )
        for alias in statement.names:
            name = alias.asname or (alias.name if place else alias.name.partition(".")[0])
            kind = Kind.EFFECT if alias.name == "*" else Kind.NAME
            digest = _digest(f"import {place} {alias.name} {alias.asname}")
            asked = frozenset(f".{each}" for each in alias.name.split("."))
            yield Unit(kind, name, digest, digest, asked)

    @staticmethod
    def _function(node: ast.FunctionDef | ast.AsyncFunctionDef, owner: str) -> Iterator[Unit]:
        is_harmless = all(_name(each) in HARMLESS_DECORATORS for each in node.decorator_list)
        used: list[ast.AST]
        head: list[ast.AST] = [*node.decorator_list, node.args, *([node.returns] if node.returns else [])]
        used = [*node.decorator_list, *node.args.defaults, *(each for each in node.args.kw_defaults if each)]
        kind = Kind.METHOD if owner else Kind.NAME
        if not is_harmless:
            kind, used = Kind.EFFECT, head
            head += [each for each in node.body[:1] if _is_docstring(each)]
        names = frozenset().union(*map(names_of, used))
        yield _unit(kind, node.name, head, names, owner, prefix=type(node).__name__, is_documented=True)
        line = min(each.lineno for each in (node, *node.decorator_list))
        body = frozenset().union(*map(names_of, node.body))
        yield _unit(Kind.BODY, node.name, list(node.body), body, owner, lines=(line, node.end_lineno or line))

    def _class(self, node: ast.ClassDef, owner: str) -> Iterator[Unit]:
        qualified = f"{owner}.{node.name}" if owner else node.name
        functions = [each for each in node.body if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef)]
        classes = [each for each in node.body if isinstance(each, ast.ClassDef)]
        rest = [each for each in node.body if each not in functions and each not in classes]
        head = [*node.decorator_list, *node.bases, *node.keywords, *rest]
        bases = tuple(_name(each) for each in node.bases)
        is_harmless = all(_name(each) in HARMLESS_DECORATORS for each in node.decorator_list)
        if not is_harmless or any(each.arg == "metaclass" for each in node.keywords):
            bases = (*bases, "?")
        names = frozenset().union(*map(names_of, head))
        names |= {f".{name}" for name in names if name[:1] != "."}  # also those of its methods
        unit = _unit(Kind.NAME, node.name, head, names, owner, prefix="class")
        yield replace(unit, bases=bases, is_class=True)
        for function in functions:
            yield from self._function(function, qualified)
        for each in classes:
            yield from self._class(each, qualified)


def _paths(module: str) -> Iterator[str]:
    path = module.replace(".", "/")
    yield f"{path}.py"
    while path:  # importing a module runs the packages above it
        yield f"{path}/__init__.py"
        path = path.rpartition("/")[0]


def _targets(statement: ast.Assign | ast.AnnAssign) -> list[str]:
    targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
    names = [
        name
        for target in targets
        for name in (target.elts if isinstance(target, ast.Tuple | ast.List) else [target])
    ]
    return [each.id for each in names if isinstance(each, ast.Name)] if _all_names(names) else []


def _all_names(nodes: Iterable[ast.AST]) -> bool:
    return all(isinstance(each, ast.Name) for each in nodes)


def _is_harmless(statement: ast.AST) -> bool:
    return all(
        (name := _name(call.func)) in HARMLESS_CALLS or name[:1].isupper() or name.lstrip("_")[:1].isupper()
        for call in ast.walk(statement)
        if isinstance(call, ast.Call)
    )


def _name(node: ast.AST) -> str:
    """Returns the last name of `a.b`, `a.b(...)` or `a.b[...]`."""
    if isinstance(node, ast.Call):
        return _name(node.func)
    if isinstance(node, ast.Subscript):
        return _name(node.value)
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else "?"


def _is_docstring(statement: ast.AST) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )


def _is_for_types(statement: ast.AST) -> bool:
    return isinstance(statement, ast.If) and _name(statement.test) == "TYPE_CHECKING" and not statement.orelse


def _unit(
    kind: Kind,
    name: str,
    nodes: Sequence[ast.AST],
    names: frozenset[str] = frozenset(),
    owner: str = "",
    *,
    lines: tuple[int, int] = (0, 0),
    prefix: str = "",
    is_documented: bool = False,
) -> Unit:
    with_docs = _digest(prefix, *(ast.dump(each) for each in nodes))
    if is_documented:
        return Unit(kind, name, with_docs, with_docs, names, owner, lines)
    without = _digest(prefix, *(_without_docs(each) for each in nodes))
    return Unit(kind, name, without, with_docs, names, owner, lines)


def _without_docs(node: ast.AST) -> str:
    """Returns the text of a tree without texts that stand alone."""
    if _is_docstring(node):
        return ""
    docs = {ast.dump(each) for each in ast.walk(node) if _is_docstring(each)}
    text = ast.dump(node)
    for each in docs:
        text = text.replace(each, "")
    return text


def differences(before: Module, after: Module) -> list[tuple[Unit, bool]]:
    """Returns the units of two versions that the other has not, each with whether only docstrings differ."""
    found: list[tuple[Unit, bool]] = []
    for own, other in ((before, after), (after, before)):
        same = {(unit.key, unit.digest_with_docs) for unit in other.units}
        alike = {(unit.key, unit.digest) for unit in other.units}
        found += [
            (unit, (unit.key, unit.digest) in alike)
            for unit in own.units
            if (unit.key, unit.digest_with_docs) not in same
        ]
    return found


def _digest(*texts: str) -> str:
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]


def keepers(root: Path, sources: Iterable[str]) -> bytes:
    """Returns the functions whose results outlive them, sorted, as `executed.c` reads them."""
    found: set[int] = set()
    for path in sources:
        if not path.endswith(".py"):
            continue
        try:
            tree = ast.parse((root / path).read_bytes())
        except SyntaxError:
            continue  # a program that a test offers to the product
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and is_keeper(node):
                line = min(each.lineno for each in (node, *node.decorator_list))
                found.add(path_hash(path) << 32 | line)
    return b"".join(struct.pack("<Q", each) for each in sorted(found))


def is_keeper(node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    """Returns whether a function is a cache, or fills a place when it is empty: `if self._a is None: ...`."""
    if any(_name(each) in CACHES for each in node.decorator_list):
        return True
    written, asked = set[str](), set[str]()
    for each in ast.walk(node):
        if isinstance(each, ast.Global):
            return True
        if isinstance(each, ast.Assign | ast.AnnAssign | ast.AugAssign):
            targets = each.targets if isinstance(each, ast.Assign) else [each.target]
            written |= {place for target in targets if (place := _place(target))}
        elif (
            isinstance(each, ast.Call)
            and _name(each.func) in _FILLING
            and isinstance(each.func, ast.Attribute)
        ):
            written |= {place} if (place := _place(each.func.value)) else set()
        if isinstance(each, ast.If | ast.IfExp | ast.While):
            asked |= {place for part in ast.walk(each.test) if (place := _place(part))}
    return bool(written & asked)


def _fills(call: ast.Call) -> bool:
    return _name(call.func) in _FILLING


def _place(node: ast.AST) -> str:
    """Returns the name of an attribute, or of a module's variable by its form."""
    if isinstance(node, ast.Subscript):
        return _place(node.value)
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) and node.id.strip("_").isupper() else ""
