"""For which results a tick of a child is certain."""

from __future__ import annotations

import pytest

from translator.check.results.certain import EVERY, first_guard, guarded, is_understood, lifted, needed
from translator.check.results.sets import ALL, RUNS, F, K, R, S
from translator.tree import Node


def node(type_, count=2, **more):
    return Node("n", type_, children=tuple(f"c{index}" for index in range(count)), **more)


@pytest.mark.parametrize(
    ("type_", "index", "children", "certain"),
    [
        ("Sequence", 0, [S | F, S], EVERY),
        ("Sequence", 1, [S | F, S], S | K | RUNS),
        ("Sequence", 1, [S | F | R, S], S | K),
        ("Sequence", 1, [S, S], EVERY),
        ("AsyncSequence", 1, [S, S], S | F | K),
        ("Fallback", 1, [S | F, S], F | K | RUNS),
        ("Inverter", 0, [S], EVERY),
        ("Delay", 0, [S], ALL & ~R),
        ("KeepRunningUntilFailure", 0, [S], EVERY),
        ("Switch2", 0, [S, S, S], 0),
        ("ParallelAll", 1, [S, S], EVERY),
        ("Parallel", 1, [S, S], 0),
    ],
)
def test_lifted_from_a_child_that_is_always_ticked(type_, index, children, certain):
    assert lifted(node(type_, len(children)), index, children, EVERY) == certain


def test_lifted_from_a_child_that_may_be_skipped():
    assert lifted(node("Sequence"), 0, [S | K, S], S) & DONE_OF_S == 0
    assert lifted(node("Inverter", 1), 0, [S | F], S) == EVERY & ~S
    assert lifted(node("Repeat", 1, ports={"num_cycles": "0"}), 0, [S], EVERY) == 0


DONE_OF_S = S


def test_pre_conditions_decide_without_a_tick():
    assert guarded(node("Sequence", conditions={"_skipIf": "x"}), EVERY) == EVERY & ~K
    assert (
        guarded(node("Sequence", conditions={"_failureIf": "x", "_successIf": "false"}), EVERY) == EVERY & ~F
    )
    assert guarded(node("Sequence", disabled=True), EVERY) == 0
    assert first_guard(node("Sequence", conditions={"_while": "x", "_successIf": "y"})) == "_successIf"
    assert first_guard(node("Sequence")) == ""


def test_what_a_later_child_needs():
    assert needed(node("Sequence"), 0, 1) == S | K
    assert needed(node("ReactiveFallback"), 0, 1) == F | K
    assert needed(node("WhileDoElse", 3), 0, 2) == S | F
    assert needed(node("WhileDoElse", 3), 1, 2) is None
    assert needed(node("TryCatch", 3), 0, 2) == S | F | K
    assert needed(node("TryCatch", 3), 1, 2) is None
    assert needed(node("TryCatch", 3), 0, 1) == S | K
    assert needed(node("Parallel"), 0, 1) == EVERY
    assert needed(node("RoundRobin"), 0, 1) is None


def test_nodes_of_nav2_are_understood_if_they_are_those_of_the_library():
    assert not is_understood(node("RecoveryNode"), is_library=False)
    assert is_understood(node("RecoveryNode"), is_library=True)
    assert is_understood(node("Sequence"), is_library=False)
