"""Liveness of a child, from its beats and samples."""

from __future__ import annotations

from executor.child_messages import Beat
from executor.session.events import ChildLooked
from executor.session.hangs.vitals import END_AFTER_S, FAULT_AFTER_S, Vitals


def beating() -> Vitals:
    vitals = Vitals(0.0)
    vitals.beat(Beat(turns=1))
    return vitals


def look(vitals: Vitals, seconds: float, **seen: float) -> None:
    """Looks each half second, for so long."""
    start_s = vitals._looked_s
    for n in range(1, round(seconds * 2) + 1):
        values = {"waited_s": 0.0, "ran_s": 0.0} | seen
        vitals.look(ChildLooked("world", 1, "S", **values), start_s + n / 2)


def test_a_child_that_sends_nothing_hangs_and_is_lost() -> None:
    vitals = beating()
    look(vitals, FAULT_AFTER_S - 0.5)
    assert not vitals.hangs
    look(vitals, 0.5)
    assert vitals.hangs
    assert not vitals.is_lost
    look(vitals, END_AFTER_S)
    assert vitals.is_lost


def test_time_that_waits_for_a_processor_counts_little() -> None:
    vitals = beating()
    look(vitals, FAULT_AFTER_S, waited_s=0.5)
    assert not vitals.hangs


def test_a_beat_makes_it_well_again() -> None:
    vitals = beating()
    look(vitals, FAULT_AFTER_S)
    vitals.heard(from_main=False)
    vitals.beat(Beat(turns=2))
    assert vitals.is_well
