"""The blackboard: typed entries in a hierarchy of scopes, one scope for each SubTree.

A name is looked up in its own scope first. If that scope does not have it, the SubTree's remapping (or
``_autoremap``) leads to another name in the caller's scope. This happens at every access, so that the outer
entry may appear later.
"""

from collections.abc import Callable, Iterable, Iterator, MutableMapping
from typing import Any, Final

from tree_gardener.errors import PortError
from tree_gardener.type_words import type_words
from tree_gardener.values import (
    ANY,
    POLYMORPHIC,
    STRING,
    ConversionError,
    ValueType,
    as_number,
    type_name_of,
    type_of_value,
)


class _Empty:
    """The value of an entry that was declared and never written."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "EMPTY"

    def __bool__(self) -> bool:
        return False


EMPTY: Final = _Empty()


class Entry:
    """One value on the blackboard.

    Attributes:
        board: the scope that stores it.
        key: its name in that scope.
        type: None if values of any type may be written, as to an entry that a script made; ``ANY`` accepts
            them too.
        value: EMPTY until it is written.
        sequence: the number of writes.
    """

    __slots__ = ("board", "key", "sequence", "type", "value")

    def __init__(self, board: "Blackboard", key: str, kind: ValueType | None) -> None:
        self.board = board
        self.key = key
        self.type = kind
        self.value: Any = EMPTY
        self.sequence = 0

    @property
    def is_strong(self) -> bool:
        """Whether the entry refuses values of other types."""
        return self.type is not None and self.type.is_strong

    @property
    def type_name(self) -> str:
        """The declared type; if there is none, the type of the value; without a value ``empty``."""
        if self.value is EMPTY:
            return "empty"
        return self.type.name if self.type is not None and self.type.is_strong else type_name_of(self.value)

    def write(self, value: Any, writer: int = 0) -> None:
        """Stores a value unchanged; `writer` is the uid of the node that writes, 0 for none."""
        self.value = value
        self.sequence += 1
        journal = self.board.journal
        if journal is not None:
            journal(self, writer)


Journal = Callable[[Entry, int], None]


class Blackboard(MutableMapping[str, Any]):
    """The entries of one scope, with access to those of the enclosing scopes.

    Used as a mapping, it reads and writes entries by name and follows all remappings.
    """

    __slots__ = ("autoremap", "entries", "journal", "locate", "parent", "remapping", "root", "scopes")

    def __init__(self, parent: "Blackboard | None" = None) -> None:
        self.parent = parent
        self.root: Blackboard = self if parent is None else parent.root
        self.entries: dict[str, Entry] = {}
        self.remapping: dict[str, str] = {}
        self.autoremap = False
        self.journal: Journal | None = None if parent is None else parent.journal
        self.locate: Callable[[], str] = str
        self.scopes: Callable[[str], Blackboard] | None = None

    @property
    def path(self) -> str:
        """The path of the SubTree to which the scope belongs; "" for the root."""
        return self.locate()

    def scope(self, path: str) -> "Blackboard":
        """Returns the scope of the SubTree with this path.

        Raises:
            KeyError: no SubTree has this path.
        """
        if not path:
            return self.root
        if self.root.scopes is None:
            raise KeyError(path)
        return self.root.scopes(path)

    def child(self) -> "Blackboard":
        """Makes a scope inside this one, of the same class."""
        return type(self)(self)

    def find(self, key: str) -> Entry | None:
        """Returns the entry that a name means in this scope, or None."""
        board = self
        while True:
            if key[:1] == "@":
                board, key = board.root, key[1:]
            entry = board.entries.get(key)
            if entry is not None:
                return entry
            parent = board.parent
            if parent is None:
                return None
            outer = board.remapping.get(key)
            if outer is not None:
                key = outer
            elif not board.autoremap or key[:1] == "_":
                return None
            board = parent

    def create(self, key: str, kind: ValueType | None) -> Entry:
        """Declares an entry in the scope to which the remapping leads; if the entry exists, returns it.

        Raises:
            PortError: the entry exists with another type.
        """
        board = self
        if key.count("@") > 1 and key.startswith("@"):
            raise PortError(f"'@' is used more than once in the name '{key}'")
        while True:
            if key[:1] == "@":
                board, key = board.root, key[1:]
            entry = board.entries.get(key)
            if entry is not None:
                if kind is not None and kind.is_strong and entry.is_strong and entry.type is not kind:
                    assert entry.type is not None
                    raise PortError(
                        f"entry '{key}' was declared as {type_words(entry.type.name)}"
                        f" and is used as {type_words(kind.name)} now"
                    )
                return entry
            outer = board.remapping.get(key)
            if board.parent is None or (outer is None and (not board.autoremap or key[:1] == "_")):
                entry = board.entries[key] = Entry(board, key, kind)
                return entry
            board, key = board.parent, key if outer is None else outer

    def set(self, key: str, value: Any, kind: ValueType | None = None, writer: int = 0) -> None:
        """Writes a value as a typed output port does; `kind` None or ANY is BT.CPP's ``set<Any>``.

        Raises:
            PortError: the value cannot be converted to the type of the entry.
        """
        if key[:1] == "@":
            if "@" in key[1:]:
                raise PortError(f"'@' is used more than once in the name '{key}'")
            self.root.set(key[1:], value, kind, writer)
            return
        entry = self.entries.get(key)
        if entry is None:
            # A string makes no typed entry, because constants of SubTrees come this way.
            if kind is POLYMORPHIC:
                kind = type_of_value(value)
            declared = None if kind is STRING or kind is ANY else kind
            self.create(key, declared).write(value, writer)
        else:
            _assign(entry, value, kind, writer)

    def unset(self, key: str, writer: int = 0) -> None:
        """Removes an entry of this scope, if it exists; remappings are not followed."""
        entry = self.entries.pop(key, None)
        if entry is not None and self.journal is not None:
            self.journal(entry, writer)

    def __getitem__(self, key: str) -> Any:
        entry = self.find(key)
        if entry is None or entry.value is EMPTY:
            raise KeyError(key)
        return entry.value

    def __setitem__(self, key: str, value: Any) -> None:
        entry = self.find(key)
        if entry is None:
            entry = self.create(key, None)
        elif entry.is_strong:
            assert entry.type is not None
            try:
                value = entry.type.convert(value)
            except ConversionError as error:
                raise PortError(f"entry '{key}' holds {type_words(entry.type.name)}: {error}") from None
        entry.write(value)

    def __delitem__(self, key: str) -> None:
        entry = self.find(key)
        if entry is None:
            raise KeyError(key)
        entry.board.unset(entry.key)

    def __contains__(self, key: object) -> bool:
        entry = self.find(key) if isinstance(key, str) else None
        return entry is not None and entry.value is not EMPTY

    def __iter__(self) -> Iterator[str]:
        return (key for key, entry in self.entries.items() if entry.value is not EMPTY)

    def __len__(self) -> int:
        return sum(1 for _ in self)


def _kept_kind(entry: Entry, value: Any) -> Any:
    """Converts a number to the kind of number that the entry holds, as BT.CPP's ``Any::copyInto``."""
    old, number = as_number(entry.value), as_number(value)
    if old is None or isinstance(entry.value, bool):
        return value
    if number is None:
        if isinstance(value, str):
            raise PortError(f"entry '{entry.key}' holds a number, and a string cannot take its place")
        return value
    if isinstance(old, float):
        return float(number)
    if isinstance(number, float) and not number.is_integer():
        raise PortError(f"entry '{entry.key}' holds a whole number, and {number} is not one")
    return value if isinstance(value, bool) else int(number)


def _converted(entry: Entry, value: Any, kind: ValueType, declared: ValueType) -> Any:
    """Returns a value of the type `kind` as one of the entry's type `declared`."""
    try:
        # Numbers convert to numbers without loss, and a string is parsed; anything else is an error.
        if kind is not STRING and (declared is STRING or isinstance(entry.value, str)):
            raise ConversionError(f"{type_words(kind.name)} is not a text")
        return declared.parse(value) if kind is STRING else declared.convert(value)
    except ConversionError as error:
        raise PortError(
            f"entry '{entry.key}' was declared as {type_words(declared.name)}"
            f" and is written as {type_words(kind.name)}: {error}"
        ) from None


def _assign(entry: Entry, value: Any, kind: ValueType | None, writer: int) -> None:
    """Writes a value of the type `kind` to an entry of this scope."""
    declared = entry.type
    if declared is None or not declared.is_strong:
        if kind is POLYMORPHIC:
            kind = type_of_value(value)
        entry.type = ANY if kind is None else kind
        entry.write(value, writer)
        return
    if kind is not declared and kind is not None:
        if kind is POLYMORPHIC:
            kind = type_of_value(value)
        if kind.is_strong and kind is not declared:
            value = _converted(entry, value, kind, declared)
    entry.write(value if kind is None else _kept_kind(entry, value), writer)


def board_at(boards: Iterable[Blackboard], path: str) -> Blackboard:
    """Returns the scope with a path.

    Raises:
        KeyError: there is none.
    """
    for board in boards:
        if board.path == path:
            return board
    raise KeyError(path)
