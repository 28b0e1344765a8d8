"""The sentence about an action for which the world waits."""

from __future__ import annotations

from executor.child_messages import Log, Place
from executor.exact.slow_ticks import SlowTicks

IN_ACTION = Place("Act 'Act::1' (actions/Act.py:3)", "n1", "Main", "Act::1", "Act", "actions/Act.py", 3)


def test_it_is_said_once_and_only_in_a_tick() -> None:
    said: list[Log] = []
    place, is_ticking = Place("executor/loop.py:3"), True
    slow = SlowTicks(lambda _: place, lambda: is_ticking, said.append)
    assert slow(None) is place
    place, is_ticking = IN_ACTION, False
    slow(None)
    assert said == []
    is_ticking = True
    assert slow(None) is place
    slow(None)
    text = "The world waits for Act 'Act::1' (actions/Act.py:3); Delay or RUNNING lets it move."
    assert said == [Log("warning", text, "n1", "Act::1", of_world=True)]
