from typing import Any

from tree_gardener.blackboard import EMPTY
from tree_gardener.errors import PortError, TickError
from tree_gardener.node import SyncLeaf
from tree_gardener.ports import entry_key
from tree_gardener.status import FAILURE, SUCCESS, Status
from tree_gardener.type_words import type_words
from tree_gardener.values import ANY, DOUBLE, INT_64, STRING, ConversionError, ValueType, to_text


class SetBlackboard(SyncLeaf):
    """Writes a value, or a copy of an entry, to the blackboard.

    A literal is stored as a string if the entry is new, and converted if the entry has a type.
    ``value="{source}"`` copies value and type; a source without a value makes the node fail. `output_key` is
    the entry's name; in it, ``"{key}"`` means the entry whose name is stored in `key`. A literal written to
    an entry that a script made leaves that entry without a value, as in BehaviorTree.CPP.
    """

    __slots__ = ()

    def run(self) -> Status:
        try:
            return self.write(to_text(self.get("output_key")))
        except (PortError, ConversionError) as error:
            raise TickError(self, str(error)) from None

    def write(self, key: str) -> Status:
        given = self.ports.get("value")
        if given is None:
            raise TickError(self, "port 'value' was given no value")
        pointer = entry_key(given)
        value: Any = given
        kind: ValueType | None = STRING
        if pointer != given:
            source = self.board.find(pointer)
            if source is None:
                raise TickError(self, f"port 'value': the entry '{pointer}' does not exist")
            value, kind = source.value, source.type
        target = self.board.find(key) or self.board.create(key, kind)
        if value is EMPTY:
            return FAILURE
        if isinstance(value, str) and target.type is not STRING:
            value = self.parsed(value, target.type)
        elif target.is_strong and target.type is not _copied_type(value, kind):
            assert target.type is not None
            held = type_words(target.type.name)
            message = f"the entry '{key}' holds {held} and takes no copy of '{pointer}'"
            raise TickError(self, message)
        self.board.set(key, value, None, self.uid)
        return SUCCESS

    def parsed(self, text: str, kind: ValueType | None) -> Any:
        """Returns a text as a value of the entry's type."""
        if kind is None:
            return EMPTY
        if kind is ANY:
            raise TickError(self, f"'{text}' cannot be converted to an entry without a type")
        try:
            return kind.parse(text)
        except ConversionError as error:
            raise TickError(self, f"'{text}' cannot be written to the entry: {error}") from None


def _copied_type(value: Any, kind: ValueType | None) -> ValueType | None:
    """Returns the type of a copied value: that of its entry, or the type that scripts would give it."""
    if kind is not None and kind.is_strong:
        return kind
    if isinstance(value, str):
        return STRING
    if isinstance(value, float):
        return DOUBLE
    return INT_64 if isinstance(value, int) else kind


class UnsetBlackboard(SyncLeaf):
    """Removes an entry from the blackboard and succeeds, also if the entry does not exist.

    Only an entry of the tree's own blackboard is removed, never one that a SubTree's attributes lead to.
    """

    __slots__ = ()

    def run(self) -> Status:
        self.board.unset(self.get("key"), self.uid)
        return SUCCESS


class WasEntryUpdated(SyncLeaf):
    """Succeeds if a blackboard entry was written since the last test, else fails."""

    __slots__ = ("key", "seen")
    NEEDS = READ_AT_LOAD = "entry"

    def prepare(self) -> None:
        self.seen = 0
        self.key = entry_key(self.ports.get("entry", ""))

    def run(self) -> Status:
        entry = self.board.find(self.key)
        if entry is None:
            return FAILURE
        before, self.seen = self.seen, entry.sequence
        return SUCCESS if before != entry.sequence else FAILURE
