"""The pool: as many executors as are wanted, none that is old, none without a row."""

from __future__ import annotations

import time
from datetime import timedelta
from uuid import uuid4

import pytest
from django.utils import timezone

from backend.sessions.launchers.kubernetes.bodies import PATIENCE_S, Kind, pod_name
from backend.sessions.lifecycle import drain
from backend.sessions.models import WarmExecutor
from backend.sessions.warm import pool
from tests.backend.sessions.conftest import spec

pytestmark = pytest.mark.django_db(transaction=True)


def ids():
    return {str(one) for one in WarmExecutor.objects.values_list("id", flat=True)}


def names():
    return sorted(pod_name(Kind.WARM, one) for one in ids())


def test_as_many_are_started_as_are_missing(pods, cluster):
    for _ in range(2):
        pool.keep_warm()
        assert cluster.names("pods") == names()
        assert len(names()) == 2
    arguments = cluster.object("pods", names()[0])["spec"]["containers"][0]["args"]
    assert f"--patience={PATIENCE_S}" in arguments
    assert timedelta(seconds=PATIENCE_S) > pool.OLDEST


def test_one_that_is_old_has_ended_or_never_started_is_replaced(pods, cluster):
    pool.keep_warm()
    old, ended = WarmExecutor.objects.order_by("created_at")
    WarmExecutor.objects.filter(id=old.id).update(
        created_at=timezone.now() - pool.OLDEST - timedelta(seconds=1)
    )
    name = pod_name(Kind.WARM, str(ended.id))
    cluster.set_status(name, phase="Succeeded", conditions=[])
    pods._pods.wait(name, lambda seen: seen.exit_status is not None, time.monotonic() + 60)
    abandoned = WarmExecutor.objects.create(created_at=timezone.now() - timedelta(hours=1))
    pool.keep_warm()
    assert not {str(old.id), str(ended.id), str(abandoned.id)} & ids()
    assert cluster.names("pods") == names()
    assert len(names()) == 2


def test_one_whose_session_is_over_is_ended_and_one_that_is_being_started_stays(pods, cluster):
    pool.keep_warm()
    claimed = WarmExecutor.objects.first()
    WarmExecutor.objects.filter(id=claimed.id).update(claimed_by=uuid4())
    starting = WarmExecutor.objects.create(created_at=timezone.now())
    pool.keep_warm()
    assert str(claimed.id) not in ids()
    assert str(starting.id) in ids()
    assert pod_name(Kind.WARM, str(claimed.id)) not in cluster.names("pods")


def test_those_of_a_killed_server_are_ended_and_others_stay(pods, cluster):
    pool.keep_warm()
    pods.warm(spec(session_id="left"))
    pool.end_leftovers()
    assert cluster.names("pods") == names()
    assert len(names()) == 2


def test_no_room_is_no_error_and_is_left_alone_for_a_while(pods, cluster):
    cluster.quota = 1
    pool.keep_warm()
    assert cluster.names("pods") == names()
    assert len(names()) == 1
    before = len(cluster.asked)
    pool.keep_warm()
    assert [verb for verb, _ in cluster.asked[before:]].count("create") == 0


def test_a_row_that_went_while_its_executor_started_takes_it_along(pods, cluster, monkeypatch):
    warm = pods.warm

    def removed_meanwhile(asked):
        WarmExecutor.objects.all().delete()
        return warm(asked)

    monkeypatch.setattr(pods, "warm", removed_meanwhile)
    pool.keep_warm()
    assert cluster.names("pods") == []


def test_what_a_launcher_cannot_do_is_logged(pods, monkeypatch, caplog):
    def broken(asked):
        raise ZeroDivisionError

    monkeypatch.setattr(pods, "warm", broken)
    pool.keep_warm()
    assert "no executor is kept warm" in caplog.text
    assert ids() == set()


def test_none_is_started_during_a_drain(pods, cluster, monkeypatch):
    monkeypatch.setattr(drain, "current", object)
    pool.keep_warm()
    assert cluster.names("pods") == []


def test_a_launcher_without_warm_executors_is_left_alone(fake_manager, monkeypatch):
    launcher = fake_manager("echo")
    monkeypatch.setattr(pool, "launcher", lambda: launcher)
    pool.keep_warm()
    pool.end_leftovers()
    assert ids() == set()
