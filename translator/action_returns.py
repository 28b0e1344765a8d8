"""The results that an action can return, read from its syntax tree without running it.

A class may state them, ``RETURNS = {"SUCCESS", "RUNNING"}`` or ``RETURNS = {Status.SUCCESS}``, which counts.
Otherwise they are those of its `update`, if each of its returns names one, as in
``return py_trees.common.Status.RUNNING``. What was read is kept by the hash of the source.
"""

from __future__ import annotations

import ast
from collections import OrderedDict
from dataclasses import dataclass
from hashlib import blake2b
from typing import TYPE_CHECKING, Final

from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterator

STATUSES: Final = frozenset(("SUCCESS", "FAILURE", "RUNNING", "SKIPPED"))
RETURNS: Final = "RETURNS"
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)
_KEPT: Final = 4096


@dataclass(frozen=True, slots=True)
class Returns:
    """The results of an action.

    Attributes:
        known: the results that it can return; empty if they are not plain to see.
        named: those that its returns name, perhaps among others.
        declared: whether the class states them.
        is_sync: whether it is a SyncAction or a Condition, which never returns RUNNING.
        line: the line of the declaration, or that of the class.
        problem: a sentence about a wrong declaration, or "".
    """

    known: frozenset[str] = frozenset()
    named: frozenset[str] = frozenset()
    declared: bool = False
    is_sync: bool = False
    line: int = 1
    problem: str = ""


_read: OrderedDict[tuple[bytes, str], Returns] = OrderedDict()


def returns_of(source: str, name: str) -> Returns:
    """Returns the results of the class `name` in a source; those of a source that was read are kept."""
    key = blake2b(source.encode("utf-8", "surrogatepass"), digest_size=16).digest(), name
    found = _read.get(key)
    if found is None:
        found = _read[key] = _returns_of(source, name)
        if len(_read) > _KEPT:
            _read.popitem(last=False)
    return found


def returned_statuses(source: str, name: str) -> frozenset[str]:
    """Returns the results that the class `name` can return; empty if they are not plain to see."""
    return returns_of(source, name).known


def _returns_of(source: str, name: str) -> Returns:
    try:
        module = parse(source, f"actions/{name}.py")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return Returns()
    classes = [item for item in module.body if isinstance(item, ast.ClassDef) and item.name == name]
    if not classes:
        return Returns()
    cls = classes[-1]
    try:
        return _of_class(cls)
    except RecursionError:
        return Returns(line=cls.lineno)


def _of_class(cls: ast.ClassDef) -> Returns:
    known, named = _of_update(cls)
    kind = next((value for _, value in reversed(_assigned(cls, "NODE_KIND"))), None)
    is_sync = isinstance(kind, ast.Constant) and kind.value in {"SyncAction", "Condition"}
    declared = _assigned(cls, RETURNS)
    if not declared:
        return Returns(known, named, is_sync=is_sync, line=cls.lineno)
    place, value = declared[-1]
    stated, problem = _declared(value)
    if not problem and (missing := named - stated):
        problem = f"update returns {' and '.join(sorted(missing))} too"
    if problem:
        return Returns(known, named, is_sync=is_sync, line=place.lineno, problem=problem)
    return Returns(stated, stated, declared=True, is_sync=is_sync, line=place.lineno)


def _of_update(cls: ast.ClassDef) -> tuple[frozenset[str], frozenset[str]]:
    """Returns the results of `update` (empty if they are not plain), and the names that it uses."""
    updates = [
        item
        for item in cls.body
        if isinstance(item, ast.FunctionDef | ast.AsyncFunctionDef) and item.name == "update"
    ]
    if not updates:
        return frozenset(), frozenset()
    update = updates[-1]
    named: set[str] = set()
    # A wrapper, or an assignment in the class, may change what `update` returns.
    is_plain = not (
        update.decorator_list or _assigned(cls, "update") or isinstance(update, ast.AsyncFunctionDef)
    )
    for value in _returns(update):
        names, is_whole = _names(value)
        named |= names
        is_plain = is_plain and is_whole
    return frozenset(named) if is_plain else frozenset(), frozenset(named)


def _assigned(cls: ast.ClassDef, name: str) -> list[tuple[ast.stmt, ast.expr]]:
    """Returns the assignments of a name in the body of a class."""
    found: list[tuple[ast.stmt, ast.expr]] = []
    for item in cls.body:
        if isinstance(item, ast.Assign):
            targets: list[ast.expr] = item.targets
        elif isinstance(item, ast.AnnAssign):
            targets = [item.target]
        else:
            continue
        if item.value is not None and any(
            isinstance(target, ast.Name) and target.id == name for target in targets
        ):
            found.append((item, item.value))
    return found


def _declared(value: ast.expr) -> tuple[frozenset[str], str]:
    """Returns the results of a declaration, and its problem."""
    call = value
    if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "frozenset":
        value = call.args[0] if len(call.args) == 1 and not call.keywords else call
    if not isinstance(value, ast.Set | ast.Tuple | ast.List) or not value.elts:
        return frozenset(), "it is no set of results"
    found: set[str] = set()
    for item in value.elts:
        name = item.value if isinstance(item, ast.Constant) else next(iter(_names(item)[0]), None)
        if not isinstance(name, str) or name not in STATUSES or isinstance(item, ast.IfExp):
            return frozenset(), f"{ast.unparse(item)[:60]} is no result"
        found.add(name)
    return frozenset(found), ""


def _returns(update: ast.FunctionDef | ast.AsyncFunctionDef) -> Iterator[ast.expr | None]:
    stack: list[ast.AST] = list(update.body)
    while stack:
        node = stack.pop()
        if isinstance(node, ast.Return):
            yield node.value
        if not isinstance(node, _SCOPES):
            stack.extend(ast.iter_child_nodes(node))


def _names(value: ast.expr | None) -> tuple[set[str], bool]:
    """Returns the results that an expression names, and whether it can be nothing else."""
    if isinstance(value, ast.IfExp):
        one, is_one = _names(value.body)
        other, is_other = _names(value.orelse)
        return one | other, is_one and is_other
    if isinstance(value, ast.Attribute) and value.attr in STATUSES:
        owner = value.value
        last = owner.attr if isinstance(owner, ast.Attribute) else getattr(owner, "id", "")
        return ({value.attr}, True) if last == "Status" else (set(), False)
    return set(), False
