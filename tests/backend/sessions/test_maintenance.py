"""The queue of a full server, and the end of unused sessions."""

from __future__ import annotations

import itertools
import json
import time
from datetime import timedelta
from typing import Any

import pytest
from asgiref.sync import async_to_sync
from django.utils import timezone

from backend.config.environment import environment
from backend.sessions import maintenance
from backend.sessions.errors import HostFullError
from backend.sessions.idleness import Ages
from backend.sessions.lease import holder
from backend.sessions.lifecycle import writes
from backend.sessions.models import Session
from tests.backend.sessions.lifecycle.test_writes import launched

pytestmark = pytest.mark.django_db(transaction=True)


@pytest.fixture
def settings_of(monkeypatch):
    """Changes settings of the environment for a test."""

    def change(**changes):
        changed = environment().model_copy(update=changes)
        for module in (writes, maintenance):
            monkeypatch.setattr(module, "environment", lambda: changed)

    return change


@pytest.fixture
def start(api):
    """Starts a session of a new project."""

    def make(name):
        project = api.post("projects", {"name": name}, expect=201)["id"]
        return api.post(f"projects/{project}/session")

    return make


def test_who_finds_no_place_waits_in_turn(api, start, fake_manager, settings_of):
    fake_manager("echo")
    settings_of(max_sessions=1)
    first, second, third = start("One"), start("Two"), start("Three")
    assert [one["state"] for one in (second, third)] == ["queued", "queued"]
    assert [one["position"] for one in (first, second, third)] == [None, 1, 2]
    launched(first["id"])
    assert writes.start_queued() == 0
    api.delete(f"sessions/{first['id']}")
    assert writes.start_queued() == 1
    launched(second["id"])
    assert api.get(f"sessions/{second['id']}")["state"] == "ready"
    assert api.get(f"sessions/{third['id']}")["position"] == 1
    api.delete(f"sessions/{third['id']}")
    api.delete(f"sessions/{second['id']}")
    assert writes.start_queued() == 0


def test_a_place_that_the_host_denies_is_waited_for(api, start, fake_manager, settings_of, monkeypatch):
    launcher = fake_manager("echo")

    def full(spec):
        raise HostFullError("All places are taken.")

    monkeypatch.setattr(launcher, "start", full)
    started = start("One")
    launched(started["id"])
    assert api.get(f"sessions/{started['id']}")["state"] == "queued"
    monkeypatch.undo()
    monkeypatch.setattr(writes, "launcher", lambda: launcher)
    assert writes.start_queued() == 1
    launched(started["id"])
    assert api.get(f"sessions/{started['id']}")["state"] == "ready"
    api.delete(f"sessions/{started['id']}")


async def warned(session_id):
    """Returns the notices that a browser with this session gets."""
    told = []

    async def send(message):
        told.append(json.loads(message["text"]))

    attendance = maintenance.Attendance()
    attendance.join(session_id, send)
    await attendance.warn(session_id, "It ends in 4 min.")
    await attendance.warn(session_id, "It ends in 3 min.")
    attendance.keep_warned([session_id])
    await attendance.warn(session_id, "It ends in 2 min.")
    attendance.use(session_id)
    await attendance.warn(session_id, "It ends in 5 min.")
    attendance.keep_warned([])  # it was used through another server
    await attendance.warn(session_id, "It ends in 4 min again.")
    attendance.leave(session_id, send)
    await attendance.warn(session_id, "Nobody hears this.")
    return [message["data"]["text"] for message in told]


async def test_browsers_are_warned_once_until_the_session_is_used():
    assert await warned("s1") == ["It ends in 4 min.", "It ends in 5 min.", "It ends in 4 min again."]


def test_the_idle_are_warned_and_then_ended(api, start, fake_manager, settings_of):
    fake_manager("echo")
    settings_of(session_idle_minutes=30)
    started = start("One")
    launched(started["id"])
    session = Session.objects.get()
    now = timezone.now()
    assert maintenance.ending_soon() == {}
    Session.objects.update(used_at=now - timedelta(minutes=27))
    maintenance.maintain()
    assert maintenance.ending_soon() == {session.id: 3}
    maintenance.note_used({session.id: 60.0})
    assert maintenance.ending_soon() == {}
    maintenance.note_used({session.id: 27 * 60.0})  # used through another server, and longer ago
    assert maintenance.ending_soon() == {}
    Session.objects.update(used_at=now - timedelta(minutes=31))
    maintenance.maintain()
    ended = api.get(f"sessions/{started['id']}")
    assert (ended["state"], ended["error"]) == ("ended", "It was ended because it was not used.")


@pytest.mark.parametrize("hours", [3, -3])
def test_a_clock_that_is_set_ends_no_session_that_is_used(
    start, fake_manager, settings_of, monkeypatch, hours
):
    fake_manager("echo")
    settings_of(session_idle_minutes=30)
    launched(start("One")["id"])
    maintenance.maintain()
    clock: dict[str, Any] = {"wall": timezone.now(), "steady": time.monotonic()}
    monkeypatch.setattr(maintenance, "ages_of_use", Ages(lambda: clock["wall"], lambda: clock["steady"]))
    monkeypatch.setattr(timezone, "now", lambda: clock["wall"])
    assert maintenance.ending_soon() == {}
    clock["wall"] += timedelta(hours=hours)
    maintenance.maintain()
    assert maintenance.ending_soon() == {}
    clock["wall"] += timedelta(minutes=29)
    clock["steady"] += 29 * 60
    assert list(maintenance.ending_soon().values()) == [1]
    maintenance.note_used({Session.objects.get().id: 0.0})
    assert maintenance.ending_soon() == {}
    maintenance.maintain()
    assert Session.objects.get().state == "ready"


def test_a_session_that_cannot_be_ended_does_not_stop_the_round(
    start, fake_manager, settings_of, monkeypatch
):
    fake_manager("echo")
    settings_of(session_idle_minutes=30)
    started = [start(name)["id"] for name in ("One", "Two")]
    for one in started:
        launched(one)
    maintenance.maintain()
    Session.objects.update(used_at=timezone.now() - timedelta(minutes=31))
    end, refresh, kept = writes.end_session, writes.refresh, []

    def stubborn(session, *arguments):
        if str(session.id) == started[0]:
            raise RuntimeError("it does not end")
        return end(session, *arguments)

    def unknown(session):
        if str(session.id) == started[0]:
            raise OSError("its launcher does not know it")
        return refresh(session)

    monkeypatch.setattr(writes, "end_session", stubborn)
    monkeypatch.setattr(writes, "refresh", unknown)
    monkeypatch.setattr(maintenance, "keep_warm", lambda: kept.append(True))
    maintenance.maintain()
    assert [Session.objects.get(id=one).state for one in started] == ["ready", "ended"]
    assert kept == [True]


def test_a_session_whose_tree_is_held_is_in_use(start, fake_manager, settings_of):
    fake_manager("held")
    settings_of(session_idle_minutes=30)
    launched(start("One")["id"])
    Session.objects.update(used_at=timezone.now() - timedelta(minutes=31))
    maintenance.maintain()
    assert Session.objects.get().state == "ready"
    assert timezone.now() - Session.objects.get().used_at < timedelta(minutes=1)
    assert maintenance.ending_soon() == {}


def test_the_dead_are_noted_without_anyone_asking(api, start, fake_manager):
    launcher = fake_manager("echo")
    started = start("One")
    launched(started["id"])
    launcher.stop(Session.objects.get().launcher_state, timeout_s=5)
    maintenance.maintain()
    assert Session.objects.get().state in {"failed", "ended"}


def test_a_server_that_takes_the_lease_looks_first_for_what_the_last_holder_left(monkeypatch):
    answers = iter([False, False, *[True] * (maintenance.ROUNDS_TO_ORPHANS + 1)])
    looked: list[bool] = []
    monkeypatch.setattr(holder, "hold", lambda *_: next(answers))
    monkeypatch.setattr(maintenance, "is_alone", lambda: False)
    monkeypatch.setattr(maintenance, "maintain", lambda *, is_for_orphans: looked.append(is_for_orphans))

    async def rounds():
        rounds_held = itertools.count()
        for _ in range(maintenance.ROUNDS_TO_ORPHANS + 3):
            await maintenance.one_round(rounds_held)

    async_to_sync(rounds)()
    assert looked == [True, *[False] * (maintenance.ROUNDS_TO_ORPHANS - 1), True]
