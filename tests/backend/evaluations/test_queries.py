"""Reads of evaluations."""

from __future__ import annotations

from uuid import uuid4

import pytest
from msgspec.structs import replace

from backend.core.problems import NotFoundError
from backend.evaluations import queries, writes
from backend.evaluations.models import Evaluation
from tests.backend.evaluations.conftest import begin, done, line, store, wish


def test_who_reads_the_project_sees_its_evaluations_the_newest_first(people):
    first, second = wish(people), wish(people, "editor")
    _, rows = queries.evaluations(people.project.id, user=people.viewer.user)
    assert rows == [second, first]
    with pytest.raises(NotFoundError):
        queries.evaluations(people.project.id, user=people.other.user)
    with pytest.raises(NotFoundError):
        queries.evaluation(people.project.id, uuid4(), user=people.viewer.user)


def test_outcomes_come_in_the_order_in_which_they_were_stored_and_lines_in_that_of_the_seeds(people):
    found = wish(people)
    store(found, done(2), done(0))
    store(found, done(1, "failure"))
    rows = queries.outcomes(found, 1, 0)
    assert [row.seed for row in rows] == [2, 0, 1]
    assert queries.outcomes(found, 1, rows[1].pk) == [rows[2]]
    assert list(queries.lines(found, 1)) == [line(0), line(1, "failure"), line(2)]
    assert queries.counts([found]) == {(found.id, 1): {"success": 2, "failure": 1}}
    with pytest.raises(NotFoundError):
        queries.outcome(found, 1, 9)


def test_a_page_of_outcomes_is_bounded_by_the_bytes_of_their_lines(people, monkeypatch):
    found = wish(people)
    store(found, done(0), done(1), done(2))
    monkeypatch.setattr(queries, "OUTCOME_BYTES_AT_A_TIME", len(line(0)) + len(line(1)))
    rows = queries.outcomes(found, 1, 0)
    assert [row.seed for row in rows] == [0, 1]
    monkeypatch.setattr(queries, "OUTCOME_BYTES_AT_A_TIME", 1)
    assert [row.seed for row in queries.outcomes(found, 1, rows[-1].pk)] == [2]


def test_what_a_run_costs_is_known_from_the_last_evaluation_of_each_name(people):
    old, other, last, sealed = (wish(people) for _ in range(4))
    Evaluation.objects.filter(id=other.id).update(name="hall")
    begin(last, 2)
    for found, each_s in ((old, 9.0), (last, 1.0), (last, 3.0), (sealed, 5.0)):
        seed = len(queries.known(found, 1))
        store(found, replace(done(seed), cpu_s=each_s))
    Evaluation.objects.filter(id=sealed.id).update(sealed=True)
    _, rows = queries.evaluations(people.project.id, user=people.viewer.user)
    assert queries.costs(rows) == [{"name": "room", "cpu_s": 2.0, "workers": 2}]
    store(other, replace(done(0), cpu_s=7.0))
    _, rows = queries.evaluations(people.project.id, user=people.viewer.user)
    assert [cost["cpu_s"] for cost in queries.costs(rows)] == [2.0, 7.0]


def test_a_replay_is_seen_by_who_asked_for_it(people):
    found = wish(people)
    store(found, done(0))
    viewer = people.viewer.user
    replay = writes.ask_replay(people.project.id, found.id, 1, 0, acting_user=viewer)
    assert queries.replay(found, replay.id, user=viewer) == replay
    with pytest.raises(NotFoundError):
        queries.replay(found, replay.id, user=people.owner.user)
