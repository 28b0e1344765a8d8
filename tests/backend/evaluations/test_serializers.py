"""Evaluations as JSON."""

from __future__ import annotations

from backend.evaluations import queries
from backend.evaluations.choices import WaitsFor
from backend.evaluations.models import Outcome
from backend.evaluations.results import Comparison, MeasureDifference
from backend.evaluations.serializers import (
    may_start,
    presented,
    presented_comparison,
    presented_outcome,
    presented_whole,
)
from backend.projects.choices import Role
from tests.backend.evaluations.conftest import begin, done, store, wish


def test_an_evaluation_shows_how_far_it_is(people):
    found = wish(people)
    before = presented(found, {}, {})
    assert before["sides"] == [
        {"revision": 1, "done": 0, "wanted": None, "rate": 0, "low": 0, "high": 0, "counts": {}}
    ]
    begin(found)
    store(found, done(0), done(1, "failure", 2))
    found.refresh_from_db()
    after = presented(found, queries.counts([found]), {})
    assert (after["state"], after["left_s"], after["author"]) == ("running", 9.0, "owner")
    [side] = after["sides"]
    assert (side["done"], side["wanted"], side["counts"]) == (2, 4, {"success": 1, "failure": 1})


def test_an_evaluation_says_that_it_waits_and_for_what(people):
    found = wish(people)
    assert presented(found, {}, {})["waits_for"] == ""
    told = presented(found, {}, {found.id: WaitsFor.USERS})
    assert (told["state"], told["waits_for"], told["sealed"]) == ("waiting", "users", False)


def test_an_outcome_has_the_margin_of_the_item_that_decided(people):
    found = wish(people)
    store(found, done(3, "failure"))
    row = Outcome.objects.get()
    told = presented_outcome(row)
    assert told == {
        "seed": 3,
        "outcome": "failure",
        "why": "so",
        "end_s": 2.5,
        "margin": 0.5,
        "unit": "m",
        "measures": {"path_length_m": 3.0},
    }
    assert presented_whole(row)["outcome"]["seed"] == 3


def test_guests_and_viewers_start_nothing():
    assert [may_start(role, is_guest=False) for role in (Role.VIEWER, Role.EDITOR, Role.OWNER)] == [
        False,
        True,
        True,
    ]
    assert not may_start(Role.OWNER, is_guest=True)


def test_a_comparison_has_its_measures():
    found = Comparison((0.1, 0.0, 0.2), 0.5, 1, 2, [3], [], [MeasureDifference("m", 2, (1, 0, 2))])
    told = presented_comparison(found)
    assert told["measures"] == [{"name": "m", "pairs": 2, "difference": [1, 0, 2]}]
    assert (told["difference"], told["only_older"]) == ([0.1, 0.0, 0.2], [3])
