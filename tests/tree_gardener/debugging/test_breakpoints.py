from __future__ import annotations

from typing import Any

import pytest

from tests.tree_gardener.debugging.trees import User, named, tree_of
from tree_gardener import Status, Tree
from tree_gardener.debugging import Breakpoint, BreakpointError, Place, When, place_of


def stops(tree: Tree, ticks: int, **how: Any) -> tuple[list[str], User]:
    """The stops of a breakpoint at the node `a`."""
    user = User(tree)
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "a")), **how)])
    found = []
    for number in range(ticks):
        tree.blackboard["n"] = number
        tree.tick_exactly_once()
        found += [f"{number} {stop}" for stop in user.take()]
    return found, user


def leaf() -> Tree:
    return tree_of('<Inverter><Leaf name="a.SRFS"/></Inverter>')


@pytest.mark.parametrize(
    ("how", "expected"),
    [
        (
            {},
            ["0 a: before its tick", "1 a: before its tick", "2 a: before its tick", "3 a: before its tick"],
        ),
        (
            {"when": When.AFTER},
            [
                f"{n} a: it returned {result}"
                for n, result in enumerate(("SUCCESS", "RUNNING", "FAILURE", "SUCCESS"))
            ],
        ),
        ({"when": When.RETURNS, "status": Status.FAILURE}, ["2 a: it returned FAILURE"]),
        ({"when": When.RETURNS, "status": Status.RUNNING}, ["1 a: it returned RUNNING"]),
        ({"condition": "n == 2"}, ["2 a: before its tick"]),
        ({"hits": 3}, ["2 a: before its tick", "3 a: before its tick"]),
        ({"condition": "n > 0", "hits": 2}, ["2 a: before its tick", "3 a: before its tick"]),
        ({"is_on": False}, []),
    ],
)
def test_when_a_breakpoint_stops(how: dict[str, Any], expected: list[str]) -> None:
    assert stops(leaf(), 4, **how)[0] == expected


def test_a_breakpoint_with_a_log_line_writes_it_and_continues() -> None:
    found, user = stops(leaf(), 2, log="n is {n}, not {nothing}")
    assert found == []
    assert user.said == ["a.SRFS: n is 0, not {nothing}", "a.SRFS: n is 1, not {nothing}"]


def test_a_condition_that_cannot_be_tested_stops_and_says_why() -> None:
    found, user = stops(leaf(), 1, condition="nothing == 1")
    assert found == ["0 a: before its tick"]
    assert user.last.why.startswith("the condition 'nothing == 1' of a breakpoint cannot be tested: ")


def test_hits_are_counted_on_while_other_breakpoints_change() -> None:
    tree = leaf()
    user = User(tree)
    mine = Breakpoint(place_of(named(tree, "a")), hits=3)
    user.debugger.set_breakpoints([mine])
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    user.debugger.set_breakpoints([Breakpoint(place_of(tree.nodes[0]), When.HALTED), mine])
    assert user.debugger.breakpoints.hits(mine) == 2
    tree.tick_exactly_once()
    assert user.last.why == "breakpoint 2 before its tick, hit 3"


@pytest.mark.parametrize(
    ("how", "why"),
    [
        ({"hits": 0}, "hit count is 0"),
        ({"when": When.RETURNS}, "needs RUNNING"),
        ({"status": Status.SUCCESS}, "needs RUNNING"),
        ({"when": When.RETURNS, "status": Status.IDLE}, "needs RUNNING"),
        ({"condition": "n =="}, "in the condition 'n =='"),
        ({"condition": "n = 1"}, "writes n; it may only read"),
    ],
)
def test_a_wrong_breakpoint_is_refused(how: dict[str, Any], why: str) -> None:
    with pytest.raises(BreakpointError, match=why):
        User(leaf()).debugger.set_breakpoints([Breakpoint(Place("Main", "a.SRFS"), **how)])
