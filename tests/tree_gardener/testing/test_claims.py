"""Each kind of expectation, holding and failing."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fakes.hostile_values import VALUES
from tests.tree_gardener.testing.trees_under_test import sentences, suite
from tree_gardener.status import Status
from tree_gardener.testing.cases import Claim
from tree_gardener.testing.claims import describe, same

DOUBLES = {
    "Near": ["FAILURE", "FAILURE", "SUCCESS", "SUCCESS", "FAILURE"],
    "Turn": "RUNNING",
    "Drive": "RUNNING",
}


@pytest.mark.parametrize(
    ("holds", "fails", "said"),
    [
        (
            {"at": 3, "node": "Turn", "status": "RUNNING"},
            {"at": 2, "node": "Turn", "status": "RUNNING"},
            "tick 2 (0.05 s): 'Turn::5' [Main n5]: status after the tick: wanted RUNNING, got IDLE",
        ),
        (
            {"at": "3..4", "node": "Drive", "status": "IDLE"},
            {"at": "3..5", "node": "Drive", "status": "IDLE"},
            "tick 5 (0.2 s): 'Drive::6' [Main n6]: status after the tick: wanted IDLE, got RUNNING",
        ),
        (
            {"at": 3, "node": "Near", "result": "SUCCESS"},
            {"at": 1, "node": "Turn", "result": "RUNNING"},
            "result of the tick: wanted RUNNING, got no tick",
        ),
        (
            {"at": "1..10", "root": "RUNNING"},
            {"at": 1, "root": "SUCCESS"},
            "result of the root: wanted SUCCESS, got RUNNING",
        ),
        (
            {"at": 1, "blackboard": {"speed": 0.3, "angle": None}},
            {"at": 1, "blackboard": {"speed": 0.4}},
            "the entry 'speed': wanted 0.4, got 0.3",
        ),
        (
            {"at": 3, "halted": ["Drive"]},
            {"at": 2, "halted": ["Drive"]},
            "halts while RUNNING: wanted at least 1, got 0",
        ),
        (
            {"at": "end", "ticked": {"Turn": 2}},
            {"at": "end", "ticked": {"Turn": 3}},
            "number of ticks: wanted 3, got 2",
        ),
        (
            {"eventually": {"node": "Turn", "status": "RUNNING"}, "within_s": 0.1},
            {"eventually": {"node": "Turn", "status": "RUNNING"}, "within_s": 0.05},
            "'Turn' is RUNNING did not happen within 0.05 s",
        ),
        (
            {"eventually": {"root": "RUNNING"}},
            {"eventually": {"root": "SUCCESS"}},
            "the root returns SUCCESS did not happen in the whole run; at the end result of the root",
        ),
        (
            {"never": {"node": "Drive", "status": "RUNNING", "while": {"node": "Turn", "status": "RUNNING"}}},
            {"never": {"node": "Drive", "status": "IDLE", "while": {"node": "Turn", "status": "RUNNING"}}},
            "[Main n6]: 'Drive' is IDLE while 'Turn' is RUNNING, which must never be",
        ),
        (
            {"at": 10, "root": "RUNNING"},
            {"at": 11, "root": "RUNNING"},
            "tick 11 was not reached: the run ended at tick 10",
        ),
        ({"at": "1..10", "root": "RUNNING"}, {"at": "1..12", "root": "RUNNING"}, "tick 11 was not reached"),
    ],
)
def test_each_expectation_holds_and_fails(holds, fails, said):
    test = {"blackboard": {"speed": 0.3}, "doubles": DOUBLES, "tick_hz": 20}
    assert sentences({**test, "expect": [holds]}) == []
    [found] = sentences({**test, "expect": [fails]})
    assert said in found


def test_every_expectation_that_fails_is_reported_once():
    found = sentences(
        {
            "doubles": DOUBLES,
            "expect": [{"at": "1..10", "node": "Turn", "status": "FAILURE"}, {"never": {"root": "RUNNING"}}],
        }
    )
    assert len(found) == 2


def test_a_tree_that_ends_early_leaves_expectations_unreached():
    [said] = sentences(
        {"doubles": {"Drive": "SUCCESS"}, "expect": [{"at": 2, "root": "RUNNING"}]}, suite("<Drive/>")
    )
    assert said.endswith("tick 2 was not reached: the run ended at tick 1")


@pytest.mark.parametrize(
    ("got", "wanted", "equal"),
    [
        (0.1 + 0.2, 0.3, True),
        (1.0, True, True),
        (0.0, False, True),
        (1, 2, False),
        ("a", "a", True),
        ([1.0, 2], [1, 2.0], True),
        ([1], [1, 2], False),
        (None, None, True),
        (None, 0, False),
        ("1", 1, False),
        (np.float32(0.25), 0.25, True),
        (np.arange(3), [0, 1, 2], True),
        (np.arange(3), [0, 1], False),
        (np.array(2.0), 2, True),
        (10**400, 2.5, False),
        (10**400, 10**400, True),
    ],
)
def test_values_are_compared_as_users_mean_them(got, wanted, equal):
    assert same(got, wanted) is equal


def test_any_value_can_be_compared():
    class Waits:
        def __eq__(self, _):
            while True:
                pass

        __hash__ = None

    for value in [*VALUES, Waits()]:
        for wanted in (7.5, 77, "b", [7.5], {"a": 7.5}):
            assert same(value, wanted) is False
            assert same([value], [wanted]) is False


def test_a_claim_reads_as_a_sentence():
    claim = Claim(root=Status.SUCCESS, halted=("A",), ticked={"B": 2}, blackboard={"k": 1})
    assert (
        describe(claim)
        == "the root returns SUCCESS and 'k' is 1 and 'A' was halted and 'B' was ticked 2 times"
    )
