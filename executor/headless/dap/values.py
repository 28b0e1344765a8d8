"""Variables of a held tree: blackboard, ports, and the parts of values."""

from __future__ import annotations

import re
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING, Any, Final

from tree_gardener import PortError, ScriptError
from tree_gardener.blackboard import EMPTY
from tree_gardener.descriptions import text_of
from tree_gardener.ports import NO_DEFAULT
from tree_gardener.script import Environment, compile_script, names_written, parse

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from tree_gardener.blackboard import Blackboard
    from tree_gardener.node import Node

__all__ = ["Values", "ValuesError", "shown"]

LONGEST: Final = 1000
MOST: Final = 1000
_NAME: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)
Variable = dict[str, Any]


class ValuesError(ValueError):
    """A value cannot be shown or set; the text says why."""


class Values:
    """The values that a client has asked for since the tree was held; their references end with the hold."""

    def __init__(self) -> None:
        self._parts: list[tuple[Node, Callable[[], Iterable[tuple[str, Any]]], bool]] = []

    def forget(self) -> None:
        """Ends all references, when the tree continues."""
        self._parts.clear()

    def scopes(self, node: Node) -> list[Variable]:
        """Returns the scopes of a node: its ports, and the blackboards from its own to the root's."""
        found = [
            {"name": "Ports", "presentationHint": "arguments", **self._scope(node, partial(ports, node))}
        ]
        for depth, board in enumerate(_boards(node)):
            name = f"Blackboard of {board.path}" if board.path else "Blackboard"
            hint = {} if depth else {"presentationHint": "locals"}
            found.append({"name": name, **hint, **self._scope(node, partial(entries, board), can_set=True)})
        return found

    def variables(self, reference: int) -> list[Variable]:
        """Returns the variables of a reference.

        Raises:
            ValuesError: the tree has continued since the reference was given.
        """
        node, parts, _ = self._of(reference)
        return [{"name": name, **self.described(value, node)} for name, value in islice(parts(), MOST)]

    def described(self, value: Any, node: Node) -> Variable:
        """Returns the text and the type of a value, and a reference to its parts."""
        described = {"value": shown(value), "type": "" if value is EMPTY else type(value).__name__}
        parts = _parts(value)
        return described | {"variablesReference": 0 if parts is None else self._add(node, parts)}

    def set(self, reference: int, name: str, text: str) -> Variable:
        """Writes an entry of a blackboard; `text` is an expression of the script language in its scope.

        Raises:
            ValuesError: it is no entry, or the expression is wrong or writes something itself.
        """
        node, _, can_set = self._of(reference)
        if not can_set:
            raise ValuesError("only entries of the blackboard can be set, not ports or parts of values")
        entry = next((each for each in _boards(node) if name in each.entries), node.board).entries.get(name)
        if entry is None:
            raise ValuesError(f"there is no entry '{name}'")
        environment = Environment(entry.board, node.tree.enums)
        try:
            _check_reads(text)
            if _NAME.fullmatch(name):  # an entry keeps its type, as in a script
                compile_script(f"{name} := ({text})").run(environment)
            else:
                entry.board.set(name, compile_script(text).run(environment))
        except (ScriptError, PortError) as error:
            raise ValuesError(str(error)) from None
        return self.described(entry.value, node)

    def _scope(
        self, node: Node, parts: Callable[[], Iterable[tuple[str, Any]]], *, can_set: bool = False
    ) -> Variable:
        return {"variablesReference": self._add(node, parts, can_set=can_set), "expensive": False}

    def _add(
        self, node: Node, parts: Callable[[], Iterable[tuple[str, Any]]], *, can_set: bool = False
    ) -> int:
        self._parts.append((node, parts, can_set))
        return len(self._parts)

    def _of(self, reference: int) -> tuple[Node, Callable[[], Iterable[tuple[str, Any]]], bool]:
        if not 0 < reference <= len(self._parts):
            raise ValuesError("the tree has continued since this value was shown")
        return self._parts[reference - 1]


def evaluated(text: str, node: Node, *, may_write: bool) -> Any:
    """Returns the value of a key or of a script in the scope of a node.

    Raises:
        ValuesError: it cannot be evaluated, or writes although it may not.
    """
    entry = node.board.find(text.strip())
    if entry is not None:
        return entry.value
    try:
        if not may_write:
            _check_reads(text)
        return compile_script(text).run(Environment(node.board, node.tree.enums))
    except (ScriptError, PortError) as error:
        raise ValuesError(str(error)) from None


def _check_reads(text: str) -> None:
    if names_written(parse(text)):
        raise ValuesError("it writes to the blackboard; here it may only read (use ==)")


def ports(node: Node) -> Iterable[tuple[str, Any]]:
    """Yields the ports of a node with their values at this moment."""
    manifest = node.manifest or {}
    for name in {**manifest, **node.ports}:
        if name.startswith("_"):
            continue
        spec = manifest.get(name)
        text = node.ports.get(name, NO_DEFAULT if spec is None else spec.default)
        if text is NO_DEFAULT:
            yield name, EMPTY
            continue
        key = text[1:-1].strip() if isinstance(text, str) and text[:1] == "{" and text[-1:] == "}" else ""
        entry = node.board.find(name if key == "=" else key) if key else None
        yield name, (EMPTY if entry is None else entry.value) if key else text


def entries(board: Blackboard) -> Iterable[tuple[str, Any]]:
    """Yields the entries of a blackboard by name."""
    return ((name, entry.value) for name, entry in sorted(board.entries.items()))


def shown(value: Any) -> str:
    """Returns a value as text of limited length; a class of the user may fail at it."""
    return "(empty)" if value is EMPTY else text_of(value, LONGEST)


def _boards(node: Node) -> Iterable[Blackboard]:
    board: Blackboard | None = node.board
    while board is not None:
        yield board
        board = board.parent


def _parts(value: Any) -> Callable[[], Iterable[tuple[str, Any]]] | None:
    for base in (dict, list, tuple):  # not `isinstance`, nor methods of a derived class of the user
        if issubclass(type(value), base) and base.__len__(value):
            if base is dict:
                return lambda: ((shown(key), each) for key, each in list(dict.items(value)))
            return lambda: ((f"[{index}]", each) for index, each in enumerate(base.__iter__(value)))
    return None
