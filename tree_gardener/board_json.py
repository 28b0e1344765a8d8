"""The blackboard as JSON, as BehaviorTree.CPP's ``ExportBlackboardToJSON`` and ``ImportBlackboardFromJSON``.

Numbers, texts, lists of them and registered types have a form in JSON; everything else becomes null. As
there, a boolean is written as 1 or 0, and an import replaces values without a look at the types of entries,
and without counting as an update.
"""

import math
from collections.abc import Mapping
from types import GenericAlias
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.errors import PortError
from tree_gardener.registered import TYPE, registered, registered_name
from tree_gardener.status import Status
from tree_gardener.type_words import type_words
from tree_gardener.values import (
    BOOL,
    BY_NAME,
    DOUBLE,
    INT,
    INT32,
    INT64,
    INT_64,
    STRING,
    ConversionError,
    ValueType,
    as_number,
    value_type,
    value_words,
)

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

Document = dict[str, Any]

_PYTHON: Final[dict[ValueType, Any]] = {STRING: str, BOOL: bool, DOUBLE: float, INT: int, INT_64: int}


def blackboard_to_json(board: Blackboard) -> Document:
    """Returns the entries of one scope by name; null for an entry that is empty or has no form in JSON."""
    return {key: value_to_json(entry.value) for key, entry in sorted(board.entries.items())}


def blackboard_from_json(document: Mapping[str, Any], board: Blackboard) -> list[str]:
    """Writes a document to the entries of a scope; remappings are followed, and missing entries are created.

    Returns:
        The names whose values have no type that is known here; their entries stay as they are.

    Raises:
        PortError: the value of a name does not suit the type that it names, or a list is mixed. What came
            before it is written.
    """
    left = []
    for key, value in document.items():
        try:
            found = _value_of(value)
        except ConversionError as error:
            raise PortError(f"the entry '{key}' cannot be read from JSON: {error}") from None
        if found is None:
            left.append(key)
            continue
        entry = board.find(key) or board.create(key, found[1])
        entry.value = found[0]
        if entry.board.journal is not None:
            entry.board.journal(entry, 0)
    return left


def tree_to_json(tree: "Tree") -> Document:
    """Returns all scopes, as ``ExportTreeToJSON``: by the path of the SubTree, the root by the tree's ID."""
    return {name: blackboard_to_json(board) for name, board in _scopes(tree).items()}


def tree_from_json(document: Mapping[str, Mapping[str, Any]], tree: "Tree") -> list[str]:
    """Writes a document of `tree_to_json` to a tree.

    BehaviorTree.CPP's ``ImportTreeFromJSON`` pairs scopes by their order, this by their names.

    Returns:
        The names that were left out, as `blackboard_from_json`, each after the name of its scope.

    Raises:
        PortError: the scopes of the document are not those of the tree, or a value cannot be read.
    """
    scopes = _scopes(tree)
    if document.keys() != scopes.keys():
        theirs, ours = ", ".join(sorted(document)), ", ".join(sorted(scopes))
        raise PortError(f"the document has the scopes {theirs or 'none'}, and the tree has {ours}")
    return [
        f"{name}/{key}"
        for name, board in scopes.items()
        for key in blackboard_from_json(document[name], board)
    ]


def _scopes(tree: "Tree") -> dict[str, Blackboard]:
    return {board.path or tree.nodes[0].tree_id: board for board in tree.boards}


def value_to_json(value: Any) -> Any:
    """Returns the form of a value in JSON; None if it has none, as an integer above 64 bits."""
    kind = type(value)
    if issubclass(kind, str):
        return str.__str__(value)
    number = None if kind is Status else as_number(value)
    if number is not None:
        return number if _is_written(number) else None
    if kind in (list, tuple):
        return _list_to_json(value)
    known = registered(kind)
    return known.to_json(value) if known is not None and known.to_json is not None else None


def _is_written(number: float) -> bool:
    if issubclass(type(number), float):
        return math.isfinite(number)
    return INT64[0] <= int.__int__(number) < 2**64  # type: ignore[arg-type]


def _list_to_json(values: Any) -> list[Any] | None:
    """Returns a list, in which booleans stay booleans, as in a ``std::vector<bool>``."""
    items = []
    for value in values:
        kind = type(value)
        item = None if kind in (list, tuple) else value if kind is bool else value_to_json(value)
        if item is None or isinstance(item, list):
            return None
        items.append(item)
    return items


def _value_of(document: Any) -> tuple[Any, ValueType | None] | None:
    """Returns a value with the type of a new entry for it; None if its type is not known."""
    if document is None:
        return EMPTY, None
    if isinstance(document, list):
        return _list_of(document)
    if isinstance(document, dict):
        name = document.get(TYPE)
        known = registered_name(name) if isinstance(name, str) else None
        if known is None or known.kind.from_json is None:
            return None
        return known.kind.from_json(document), known.kind
    return document, _scalar(document)


def _scalar(document: Any) -> ValueType:
    if isinstance(document, str):
        return STRING
    if isinstance(document, bool):
        return BOOL
    if isinstance(document, int):
        return INT if INT32[0] <= document <= INT32[1] else INT_64
    return DOUBLE


def _list_of(documents: list[Any]) -> tuple[Any, ValueType | None] | None:
    """Returns a list of the kind of its first element."""
    if not documents:
        return None
    first = documents[0]
    if isinstance(first, dict):
        known = registered_name(first[TYPE]) if isinstance(first.get(TYPE), str) else None
        if known is None or known.kind.from_json is None:
            return None
        return [known.kind.from_json(each) for each in documents], value_type(
            GenericAlias(list, (known.cls,))
        )
    if first is None or isinstance(first, list):
        return None
    kind = _scalar(first)
    python = _PYTHON[kind]
    wanted: Any = python if kind in (STRING, BOOL) else (int, float)
    for each in documents:
        if not isinstance(each, wanted):
            raise ConversionError(f"a list, each {type_words(kind.name)}, holds {value_words(each)}")
    return [python(each) for each in documents], BY_NAME[f"list[{kind.name}]"]
