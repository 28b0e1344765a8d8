"""The collector against a manager that says what a test wants it to say."""

from __future__ import annotations

import json
import threading
from contextlib import contextmanager

import pytest
from websockets.sync.server import serve

from backend.evaluations import collector, queries, writes
from backend.evaluations.choices import JobState
from backend.evaluations.collector import Collector
from backend.evaluations.models import Evaluation, Replay
from backend.evaluations.work import Place
from backend.sessions.lease import holder
from backend.sessions.lifecycle import writes as sessions
from tests.backend.evaluations.conftest import done, line, session_for, store, wish

pytestmark = pytest.mark.django_db(transaction=True)
PLAN = {"workers": 2, "seed": 0, "wanted": 3, "sequential": False, "duration_s": 5, "plan": {}}


def outcome(job, seed, number, **more):
    shares = {"rate": 1, "low": 0, "high": 1, "left_s": 1, "cpu_s": 2, "done": number, "wanted": 3}
    return "evaluation_outcome", {"job": job, "seed": seed, "line": line(seed), **shares, **more}


def ended(job, end="complete", **more):
    return "evaluation_ended", {"job": job, "end": end, "wanted": 3, **more}


@contextmanager
def manager(script):
    """Serves a manager; `script` yields the messages that answer a command, or None to hang up."""
    asked = []

    def handle(socket):
        for text in socket:
            message = json.loads(text)
            asked.append(message["data"])
            for answer in script(message["data"]):
                if answer is None:
                    socket.close()
                    return
                command, data = answer
                socket.send(
                    json.dumps({"id": message["id"], "command": command, "data": data, "seq": 1, "t": 0})
                )

    with serve(handle, "127.0.0.1", 0) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"127.0.0.1:{server.socket.getsockname()[1]}", asked
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture
def collect(people, monkeypatch):
    """Runs the collector in a session of the owner's, until it has nothing to do."""
    monkeypatch.setattr(collector, "LINGER_S", 0.6)
    monkeypatch.setattr(sessions.launcher(), "stop", lambda *_, **__: None)

    def run(script, **more):
        with manager(script) as (address, asked):
            session = session_for(people, address=address, launcher_state={"pid": 1}, **more)
            Collector(session, Place(people.project.id, people.owner.user.pk), lambda: True).run()
            session.refresh_from_db()
            return session, asked

    return run


def whole(data):
    known = {seed for seed, _ in data["known"]}
    yield "evaluation_started", {"job": data["job"], **PLAN}
    for number, seed in enumerate((seed for seed in range(3) if seed not in known), 1 + len(known)):
        yield outcome(data["job"], seed, number)
    yield ended(data["job"])


def test_outcomes_are_stored_without_any_page_and_the_session_ends(people, collect):
    found = wish(people)
    session, asked = collect(whole)
    found.refresh_from_db()
    assert (found.state, found.wanted, found.workers) == ("done", 3, 2)
    assert [seed for seed, _ in queries.known(found, 1)] == [0, 1, 2]
    assert session.state == "ended"
    assert [data["evaluation"] for data in asked] == ["room"]


def test_a_sealed_evaluation_is_asked_for_as_one(people, collect):
    wish(people)
    writes.start(people.project.id, "room", 0, acting_user=people.owner.user, sealed=True)
    _, asked = collect(whole)
    assert [data["sealed"] for data in asked] == [False, True]


def test_a_ray_cluster_has_one_evaluation(people, collect, settings_of):
    settings_of(launcher="kubernetes", evaluations="rayjob")
    first, second = wish(people), wish(people)
    session, asked = collect(whole, own_cluster=True)
    first.refresh_from_db()
    second.refresh_from_db()
    assert (first.state, second.state, session.state) == ("done", "waiting", "ended")
    assert len(asked) == 1


def test_an_executor_without_a_ray_cluster_leaves_evaluations_to_those_with_one(people, collect, settings_of):
    settings_of(launcher="kubernetes", evaluations="rayjob")
    found = wish(people)
    session, asked = collect(whole)
    found.refresh_from_db()
    assert (found.state, session.state, asked) == ("waiting", "ended", [])


def test_after_a_lost_connection_the_rest_alone_is_asked_for(people, collect):
    found = wish(people)

    def half(data):
        yield "evaluation_started", {"job": data["job"], **PLAN}
        yield outcome(data["job"], 0, 1)
        yield "evaluation_started", {"job": data["job"], **PLAN}
        yield ended("a job of somebody else")
        yield None

    session, first = collect(half)
    assert session.state == "ready"  # it is read again in the next round
    sessions.end_session(session)
    store(found, done(0))  # what was on its way may be lost
    _, second = collect(whole)
    found.refresh_from_db()
    assert found.state == JobState.DONE
    assert second[0]["known"] == [[0, "success"]]
    assert second[0]["job"] == first[0]["job"]


def test_a_refused_evaluation_fails_with_the_reason(people, collect):
    found = wish(people)
    collect(lambda data: [ended(data["job"], "refused", message="evaluations/room.yaml:3:1: no")])
    found.refresh_from_db()
    assert (found.state, found.error) == ("failed", "evaluations/room.yaml:3:1: no")


@pytest.mark.parametrize(
    "answer",
    [
        lambda data: ended(data["job"], "failed", message="The evaluation was killed."),
        lambda data: outcome(data["job"], 0, 1, line="no json"),
        lambda data: outcome(data["job"], 0, 1, line=line(1)),
        lambda data: outcome(data["job"], 0, 1, rate=7),
        lambda data: ("error", {"code": "bad_data", "message": "no"}),
        lambda data: ended(data["job"]),  # complete, and without an outcome
    ],
)
def test_an_executor_that_fails_or_says_what_cannot_be_is_ended_and_tried_again(people, collect, answer):
    found = wish(people)
    session, _ = collect(lambda data: [answer(data)])
    found.refresh_from_db()
    assert (found.state, found.tries, session.state) == ("waiting", 1, "ended")


def test_a_cancelled_evaluation_ends_its_session_at_once(people, collect):
    found = wish(people)

    def script(data):
        yield "evaluation_started", {"job": data["job"], **PLAN}
        yield outcome(data["job"], 0, 1)
        writes.cancel(people.project.id, found.id, acting_user=people.owner.user)

    session, _ = collect(script)
    found.refresh_from_db()
    assert (found.state, session.state) == ("cancelled", "ended")


def test_a_deleted_evaluation_ends_its_session(people, collect):
    found = wish(people)

    def script(data):
        Evaluation.objects.filter(id=found.id).delete()
        yield outcome(data["job"], 0, 1)

    assert collect(script)[0].state == "ended"


def test_a_replay_interrupts_an_evaluation_which_then_continues(people, collect):
    found = wish(people)
    owner = people.owner.user

    def script(data):
        if data.get("record"):
            yield ended(data["job"], "failed", message="no room on the disk")
        elif not data["known"]:
            yield "evaluation_started", {"job": data["job"], **PLAN}
            yield outcome(data["job"], 0, 1)
            store(found, done(0))
            writes.ask_replay(people.project.id, found.id, 1, 0, acting_user=owner)
        else:
            yield from whole(data)

    _, asked = collect(script)
    found.refresh_from_db()
    replay = Replay.objects.get()
    assert [bool(data.get("record")) for data in asked] == [False, True, False]
    assert asked[1]["seeds"] == [0]
    assert (replay.state, replay.error) == ("failed", "no room on the disk")
    assert found.state == JobState.DONE


def test_a_replay_that_is_cancelled_ends_its_session_and_keeps_nothing(people, collect):
    found = wish(people)
    store(found, done(0))
    writes.finish(found, JobState.DONE)
    owner = people.owner.user
    replay = writes.ask_replay(people.project.id, found.id, 1, 0, acting_user=owner)

    def script(data):
        writes.cancel_replay(people.project.id, found.id, replay.id, acting_user=owner)
        yield ended(data["job"], run="0" * 32)

    session, asked = collect(script)
    assert [data["record"] for data in asked] == [True]
    assert session.state == "ended"
    assert not Replay.objects.exists()


def test_another_server_that_holds_the_lease_reads_alone(people, collect, monkeypatch):
    found = wish(people)
    monkeypatch.setattr(holder, "hold", lambda *_: False)
    _, asked = collect(whole)
    found.refresh_from_db()
    assert (asked, found.state) == ([], "waiting")
