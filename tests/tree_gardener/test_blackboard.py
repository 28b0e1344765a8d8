"""The blackboard: remapping against a naive model, types, scopes."""

from __future__ import annotations

import dataclasses

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tree_gardener import PortError
from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.values import ANY, DOUBLE, INT, STRING

NAMES = st.sampled_from(["a", "b", "c", "_p"])
GLOBALS = st.sampled_from(["@a", "@b"])


@dataclasses.dataclass
class Scope:
    """A scope of the naive model: a dict, and where names lead."""

    values: dict[str, int]
    remapping: dict[str, str]
    autoremap: bool


@st.composite
def scopes(draw: st.DrawFn) -> list[Scope]:
    inner = [
        Scope({}, draw(st.dictionaries(NAMES, st.one_of(NAMES, GLOBALS), max_size=3)), draw(st.booleans()))
        for _ in range(draw(st.integers(1, 4)))
    ]
    return [Scope({}, {}, autoremap=False), *inner]


def resolve(model: list[Scope], level: int, name: str) -> tuple[int, str]:
    """Where a name of a scope leads, in the words of the rules."""
    if name.startswith("@"):
        return 0, name[1:]
    scope = model[level]
    if level == 0 or name in scope.values:
        return level, name
    if name in scope.remapping:
        return resolve(model, level - 1, scope.remapping[name])
    if scope.autoremap and not name.startswith("_"):
        return resolve(model, level - 1, name)
    return level, name


OPERATIONS = st.lists(
    st.tuples(
        st.sampled_from(["write", "read", "unset", "set"]),
        st.integers(0, 4),
        st.one_of(NAMES, GLOBALS),
        st.integers(0, 9),
    ),
    max_size=25,
)


@given(scopes(), OPERATIONS)
@settings(max_examples=150)
def test_remapping_is_that_of_a_naive_model(
    model: list[Scope], operations: list[tuple[str, int, str, int]]
) -> None:
    boards = [Blackboard()]
    for scope in model[1:]:
        board = Blackboard(boards[-1])
        board.remapping, board.autoremap = dict(scope.remapping), scope.autoremap
        boards.append(board)
    for operation, wanted, name, value in operations:
        level = min(wanted, len(model) - 1)
        place, key = resolve(model, level, name)
        if operation == "unset":
            boards[level].unset(name)
            model[level].values.pop(name, None)
        elif operation == "read":
            assert boards[level].get(name) == model[place].values.get(key)
        elif operation == "set":
            boards[level].set(name, value, INT)
            model[place].values[key] = value
        else:
            boards[level][name] = value
            model[place].values[key] = value
    for board, scope in zip(boards, model, strict=True):
        assert dict(board) == scope.values


def test_it_is_a_mapping() -> None:
    board = Blackboard()
    board["x"] = 1
    board.create("declared", INT)
    assert dict(board) == {"x": 1}
    assert len(board) == 1
    assert "declared" not in board
    assert 5 not in board
    del board["x"]
    with pytest.raises(KeyError):
        del board["x"]
    with pytest.raises(KeyError):
        board["declared"]
    with pytest.raises(KeyError):
        board.scope("there")


def test_the_first_typed_use_fixes_the_type() -> None:
    board = Blackboard()
    board.set("n", 1, INT)
    with pytest.raises(PortError, match="declared as a whole number and is used as a number"):
        board.create("n", DOUBLE)
    board.set("n", 2.0, DOUBLE)
    assert board["n"] == 2
    with pytest.raises(PortError, match="is not a whole number"):
        board.set("n", 2.5, DOUBLE)
    board.set("n", "7", STRING)
    assert board["n"] == 7
    with pytest.raises(PortError, match="holds a whole number"):
        board["n"] = "text"
    board["n"] = 8.0
    assert board["n"] == 8


def test_a_string_entry_takes_no_number() -> None:
    board = Blackboard()
    board.create("s", STRING).write("text")
    with pytest.raises(PortError, match="declared as a text"):
        board.set("s", 1, INT)


def test_an_untyped_entry_gets_its_type_at_the_first_typed_write() -> None:
    board = Blackboard()
    board["x"] = "anything"
    board.set("x", 1, INT)
    entry = board.find("x")
    assert entry is not None
    assert (entry.type, entry.type_name, entry.sequence) == (INT, "int", 2)
    board.set("y", 1, ANY)
    assert board.entries["y"].type is None
    board.set("y", 2, ANY)
    assert board.entries["y"].type is ANY


@pytest.mark.parametrize("key", ["@@x", "@x@y"])
def test_one_at_sign_is_enough(key: str) -> None:
    for use in (lambda: Blackboard().set(key, 1), lambda: Blackboard().create(key, None)):
        with pytest.raises(PortError, match="more than once"):
            use()


def test_empty_says_so() -> None:
    board = Blackboard()
    assert board.create("x", INT).type_name == "empty"
    assert repr(EMPTY) == "EMPTY"
    assert not EMPTY
