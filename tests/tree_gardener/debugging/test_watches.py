from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.tree_gardener.debugging.trees import User, named, tree_of
from tree_gardener import ScriptError, Status, Tree
from tree_gardener.backup import backup, restore
from tree_gardener.blackboard import EMPTY, Blackboard, Entry
from tree_gardener.debugging import Breakpoint, When, place_of
from tree_gardener.debugging.watches import AnyOf, Watch, Watches
from tree_gardener.script import Environment, bind_test

if TYPE_CHECKING:
    from collections.abc import Callable


class Counting:
    """Binds a condition to a scope, and counts how often it is evaluated.

    Attributes:
        after: is done at the end of each evaluation.
    """

    def __init__(self) -> None:
        self.count = 0
        self.watch: Watch
        self.after: Callable[[], object] = int

    def bind(self, text: str, environment: Environment) -> Callable[[], bool]:
        own = bind_test(text, environment)

        def test() -> bool:
            self.count += 1
            found = own()
            self.after()
            return found

        return test

    def is_true(self) -> bool:
        return self.watch.is_doubtful and self.watch.is_true()


def watched(text: str, board: Blackboard | None = None, **enums: int) -> tuple[Counting, Blackboard, Watches]:
    """A condition in a scope whose writes reach it."""
    tree = tree_of('<Leaf name="a.S"/>')
    board = board if board is not None else tree.blackboard
    node = tree.nodes[0]
    node.board = board
    tree.enums = enums
    counting = Counting()
    watches = Watches(counting.bind)
    counting.watch = watches.at(node, text)
    board.journal = watches.written
    return counting, board, watches


def test_a_false_condition_is_evaluated_again_after_a_write_of_what_it_reads() -> None:
    counting, board, _ = watched("battery < 20 && floor == LOW", LOW=1)
    board["battery"], board["floor"], board["other"] = 80.0, 1, 1
    assert [counting.is_true() for _ in range(3)] == [False] * 3
    assert counting.count == 1
    board["other"] = 2
    assert not counting.is_true()
    assert counting.count == 1
    board["battery"] = 10.0
    assert [counting.is_true() for _ in range(3)] == [True] * 3
    assert counting.count == 4
    board["floor"] = 2
    assert [counting.is_true() for _ in range(3)] == [False] * 3
    assert counting.count == 5
    assert Watch("LOW == 1", Environment(board, {"LOW": 1})).keys == frozenset()


def test_a_condition_that_cannot_be_evaluated_is_tried_each_time() -> None:
    counting, board, _ = watched("n > 1")
    for _ in range(2):
        with pytest.raises(ScriptError, match="no entry 'n'"):
            counting.is_true()
    board["n"] = 1
    assert not counting.is_true()
    del board["n"]
    with pytest.raises(ScriptError, match="no entry 'n'"):
        counting.is_true()


class Meter(int):
    """A number that changes in place."""

    reading = 0.0

    def __ge__(self, other: object) -> bool:
        return self.reading >= float(str(other))

    def __float__(self) -> float:
        return self.reading


def test_a_value_that_can_change_in_place_is_read_each_time() -> None:
    counting, board, _ = watched("meter < 20 && 1 > 0")
    meter = Meter()
    meter.reading = 50.0
    board["meter"] = meter
    assert not counting.is_true()
    meter.reading = 10.0
    assert counting.is_true()


def test_a_chain_that_ended_early_reads_the_rest_when_it_is_written() -> None:
    counting, board, _ = watched("1 < n < m")
    board["n"] = 0
    assert not counting.is_true()  # `m` is not there, and is not read
    board["m"] = 9
    assert not counting.is_true()
    board["n"] = 5
    assert counting.is_true()


class Fixed(Blackboard):
    """A scope with an entry of its own making."""

    def find(self, key: str) -> Entry | None:
        entry = Entry(self, key, None)
        entry.value = 0
        return entry


def test_a_scope_that_finds_entries_in_its_own_way_is_read_each_time() -> None:
    counting, _, _ = watched("n == 1", Fixed())
    assert [counting.is_true() for _ in range(3)] == [False] * 3
    assert counting.count == 3


def test_a_write_while_the_condition_is_read_is_not_lost() -> None:
    counting, board, _ = watched("n == 1")
    board["n"] = 0
    counting.after = lambda: board.__setitem__("n", 1)
    assert not counting.is_true()
    assert counting.is_true()


def test_equal_conditions_in_one_scope_are_one() -> None:
    tree = tree_of('<Sequence><Leaf name="a.S"/><SubTree ID="T"/></Sequence>', SUB)
    watches = Watches()
    assert not watches
    main, inner = named(tree, "a"), named(tree, "b")
    assert watches.at(main, "n == 1") is watches.at(tree.nodes[0], "n == 1")
    assert watches.at(main, "n == 1") is not watches.at(inner, "n == 1")
    assert watches.at(main, "n == 1") is not watches.at(main, "n == 2")
    assert watches


def test_of_several_conditions_one_must_be_true() -> None:
    first, board, _ = watched("n == 1")
    second = Watch("m == 1", Environment(board, {}))
    board["n"], board["m"] = 0, 0
    both = AnyOf((first.watch, second))
    assert both.is_doubtful
    assert not both.is_true()
    board["m"] = 1
    second.is_doubtful = True
    assert both.is_true()
    assert first.count == 1


SUB = """<BehaviorTree ID="T"><Sequence name="below"><Leaf name="b.S"/></Sequence></BehaviorTree>"""


def held(condition: str, body: str, more: str = SUB, at: str = "b") -> tuple[Tree, User]:
    """A tree with generated code, and a user who waits for a condition."""
    tree = tree_of(body, more)
    user = User(tree)
    for number in range(8):
        tree.blackboard["n"] = number
        tree.tick_exactly_once()
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, at)), condition=condition)])
    return tree, user


@pytest.mark.parametrize(
    ("ports", "condition"),
    [
        ('inner="{n}"', "inner == 50"),
        ('_autoremap="true"', "n == 50"),
        ("", "@n == 50"),
    ],
)
@pytest.mark.parametrize("is_observed", [False, True])
def test_an_entry_of_an_outer_scope_is_followed(ports: str, condition: str, *, is_observed: bool) -> None:
    tree, user = held(condition, f'<Sequence><Leaf name="a.S"/><SubTree ID="T" {ports}/></Sequence>')
    if is_observed:
        tree.observe(lambda changes: None)
    for value in (8, 9, 50, 51):
        tree.blackboard["n"] = value
        for _ in range(8):
            tree.tick_exactly_once()
            assert user.take() == (["b: before its tick"] if value == 50 else [])


def test_a_condition_is_true_in_the_tick_whose_script_makes_it_so() -> None:
    body = (
        '<Sequence><RunOnce><Script code="k := 0"/></RunOnce><Script code="k += 1"/>'
        '<Leaf name="a.S"/><Leaf name="b.S"/></Sequence>'
    )
    tree, user = held("k == 12", body)
    ticks = []
    for _ in range(10):
        tree.tick_exactly_once()
        if user.take():
            ticks.append(tree.blackboard["k"])
    assert ticks == [12]


def test_a_backup_that_is_restored_is_read() -> None:
    tree, user = held("n == 50", '<Sequence><Leaf name="a.S"/><Leaf name="b.S"/></Sequence>')
    tree.blackboard["n"] = 50
    saved = backup(tree)
    for value in (1, 2):
        tree.blackboard["n"] = value
        tree.tick_exactly_once()
        assert user.take() == []
    restore(tree, saved)
    tree.tick_exactly_once()
    assert user.take() == ["b: before its tick"]


def test_writes_are_followed_until_the_last_condition_is_gone() -> None:
    tree, user = held("n == 50", '<Sequence><Leaf name="a.S"/><Leaf name="b.S"/></Sequence>')
    assert tree.blackboard.journal is not None
    stop = tree.observe(lambda changes: None)
    stop()
    assert tree.blackboard.journal is not None
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "b")), When.AFTER)])
    assert tree.blackboard.journal is None
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "b")), condition="n == 50")])
    tree.debug(None)
    assert tree.blackboard.journal is None


@pytest.mark.parametrize("how", ["true", "false", "fails"])
def test_observers_hear_the_same_with_conditions_at_all_nodes(how: str) -> None:
    body = (
        '<Sequence name="all"><Leaf name="a.S"/><Fallback name="two"><Leaf name="f.F"/><Leaf name="g.FSFS"/>'
        '<Inverter><Leaf name="h.F"/></Inverter></Fallback><Sequence><Leaf name="i.S"/><Leaf name="j.SFSSF"/>'
        '</Sequence><Leaf name="k.S"/></Sequence>'
    )
    condition = {"true": "1 < 2", "false": "n > 1000", "fails": "nothing == 1"}[how]
    found = []
    for is_debugged in (False, True):
        tree = tree_of(body)
        tree.blackboard["n"] = 0
        heard: list[Any] = []
        tree.observe(lambda changes, heard=heard: heard.append(_sorted(changes)))  # type: ignore[misc]
        if is_debugged:
            user = User(tree)
            user.debugger.set_breakpoints(
                [
                    Breakpoint(place_of(node), when, status, condition)
                    for node in tree.nodes
                    for when, status in (
                        (When.BEFORE, None),
                        (When.AFTER, None),
                        (When.RETURNS, Status.SUCCESS),
                        (When.RETURNS, Status.FAILURE),
                    )
                ]
            )
        for _ in range(12):
            tree.tick_exactly_once()
        if is_debugged:
            assert bool(user.stops) is (how != "false")
        found.append(heard)
    assert found[0] == found[1]


def _sorted(changes: Any) -> Any:
    return sorted(changes.changed), sorted(changes.flashed, key=lambda flash: (flash[0], flash[1].name))


def test_an_entry_without_a_value_is_read_each_time() -> None:
    counting, board, _ = watched("n == 1")
    entry = board.create("n", None)
    assert entry.value is EMPTY
    with pytest.raises(ScriptError):
        counting.is_true()
    entry.write(1)
    assert counting.is_true()
