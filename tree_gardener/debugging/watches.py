"""Conditions of breakpoints that are evaluated only when something that they read has been written.

A condition reads entries of the blackboard and constants, so a false one stays false until one of its entries
is written or removed. Of values that can change in place nothing like this is known: a condition that reads
one, or that cannot be evaluated, is evaluated each time.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Final, Protocol

from tree_gardener.blackboard import EMPTY, Blackboard, Entry
from tree_gardener.errors import PortError, ScriptError
from tree_gardener.script import Environment, bind_test, names_read, parse

if TYPE_CHECKING:
    from collections.abc import Iterable

    from tree_gardener.node import Node

_FIXED: Final = frozenset((int, float, bool, str, type(None), type(EMPTY)))
"""The types of values that cannot change in place."""

Bind = Callable[[str, Environment], Callable[[], bool]]


class Test(Protocol):
    """A condition that generated code tests.

    Attributes:
        is_doubtful: whether it may be true; while it is not, it need not be evaluated.
    """

    is_doubtful: bool

    def is_true(self) -> bool:
        """Evaluates the condition."""


class Watch:
    """One condition in one scope of the blackboard, for all breakpoints that have it.

    Args:
        text: the condition.
        environment: its scope and constants.
        bind: makes the function that evaluates it.

    Attributes:
        is_doubtful: whether it may be true: it was so, or something that it reads has been written since.
        is_settled: whether it stays false until something is written.
        keys: the names of all entries that it may read, in whatever scope.
    """

    __slots__ = ("_test", "is_doubtful", "is_settled", "keys")

    def __init__(self, text: str, environment: Environment, bind: Bind = bind_test) -> None:
        board = environment.board
        self._test = bind(text, environment)
        read = {name.name for name in names_read(parse(text))}
        places = [
            place for name in read if environment.enums.get(name) is None for place in _places(board, name)
        ]
        self.keys = frozenset(key for _, key in places)
        entries = [scope.entries.get(key) for scope, key in places]
        self.is_settled = type(board).find is Blackboard.find and all(
            entry is None or type(entry.value) in _FIXED for entry in entries
        )
        self.is_doubtful = True

    def is_true(self) -> bool:
        """Evaluates the condition.

        Raises:
            ScriptError: it cannot be evaluated.
            PortError: likewise.
        """
        if not self.is_doubtful:
            return False
        if self.is_settled:
            self.is_doubtful = False  # before it reads: a write meanwhile makes it doubtful again
        try:
            if not self._test():
                return False
        except BaseException:
            self.is_doubtful = True
            raise
        self.is_doubtful = True
        return True


class Always:
    """Takes the place of a condition where there is none."""

    __slots__ = ()
    is_doubtful = True

    def is_true(self) -> bool:
        """Returns True."""
        return True


class AnyOf:
    """Several conditions of which one must be true."""

    __slots__ = ("_tests",)
    is_doubtful = True

    def __init__(self, tests: "Iterable[Test]") -> None:
        self._tests = tuple(tests)

    def is_true(self) -> bool:
        """Evaluates the conditions that may be true, up to the first true one."""
        return any(test.is_true() for test in self._tests if test.is_doubtful)


def may_be_true(test: Test) -> bool:
    """Evaluates a condition; returns True also if it cannot be evaluated, which is another's to report."""
    try:
        return test.is_true()
    except (ScriptError, PortError):
        return True


class Watches:
    """The conditions of a tree's breakpoints; `bind` makes the function that evaluates one."""

    def __init__(self, bind: Bind = bind_test) -> None:
        self._bind = bind
        self._found: dict[tuple[str, int], Watch] = {}
        self._readers: dict[str, list[Watch]] = {}

    def __bool__(self) -> bool:
        return bool(self._found)

    def at(self, node: "Node", text: str) -> Watch:
        """Returns a condition in the scope of a node.

        Raises:
            ScriptError: it cannot be parsed.
        """
        key = text, id(node.board)  # the tree keeps it
        watch = self._found.get(key)
        if watch is None:
            watch = self._found[key] = Watch(text, Environment(node.board, node.tree.enums), self._bind)
            for name in watch.keys:
                self._readers.setdefault(name, []).append(watch)
        return watch

    def written(self, entry: Entry, _writer: int) -> None:
        """Is called after an entry was written or removed."""
        readers = self._readers.get(entry.key)
        if readers is None:
            return
        for watch in readers:
            watch.is_doubtful = True
        if type(entry.value) not in _FIXED:
            for watch in readers:
                watch.is_settled = False


def _places(board: Blackboard, name: str) -> "Iterable[tuple[Blackboard, str]]":
    """Yields the scopes in which `Blackboard.find` looks for an entry, and its name in each."""
    while True:
        if name[:1] == "@":
            board, name = board.root, name[1:]
        yield board, name
        outer = board.remapping.get(name)
        if board.parent is None or (outer is None and (not board.autoremap or name[:1] == "_")):
            return
        board, name = board.parent, name if outer is None else outer
