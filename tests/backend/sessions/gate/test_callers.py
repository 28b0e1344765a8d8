"""Connections that have not sent a request yet."""

from __future__ import annotations

from typing import Any

from backend.sessions.gate.callers import Caller, Callers


def caller(door: str, deadline_s: float = 10.0) -> Caller:
    connection: Any = None
    return Caller(connection, door, deadline_s)


def test_the_oldest_at_a_full_door_gives_way() -> None:
    callers = Callers(per_door=2, in_all=10)
    one, two, three = (caller("a") for _ in range(3))
    assert [callers.add(each) for each in (one, two, three)] == [[], [], [one]]
    assert callers.at("a") == [two, three]
    assert one not in callers


def test_a_flood_at_one_door_costs_the_others_nothing() -> None:
    callers = Callers(per_door=10, in_all=3)
    quiet = caller("quiet")
    callers.add(quiet)
    for _ in range(5):
        callers.add(caller("loud"))
    assert len(callers) == 3
    assert quiet in callers


def test_those_whose_time_is_up_are_known() -> None:
    callers = Callers(per_door=2, in_all=3)
    late = caller("a", 1.0)
    callers.add(late)
    callers.add(caller("a", 5.0))
    assert callers.overdue(2.0) == [late]
    callers.discard(late)
    callers.discard(late)
    assert len(callers) == 1
