"""A session claims a warm executor: at once, and each has one session."""

from __future__ import annotations

import asyncio
import json
import time
from uuid import uuid4

import pytest

from backend.sessions.launchers.base import WARM
from backend.sessions.launchers.kubernetes.bodies import Kind, pod_name
from backend.sessions.lifecycle import writes
from backend.sessions.lifecycle.orphans import end_orphans
from backend.sessions.manager.sockets import manager_socket
from backend.sessions.models import Session, WarmExecutor
from backend.sessions.warm import pool
from backend.sessions.warm.claims import claim, key_of
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.fakes.kubernetes_node import Node

pytestmark = pytest.mark.django_db(transaction=True)


def creations(cluster):
    return [verb for verb, _ in cluster.asked].count("create")


def test_a_session_that_claims_a_pod_asks_the_cluster_for_nothing(api, project, pods, cluster):
    pool.keep_warm()
    before = creations(cluster)
    assert before == 4  # two pods and their secrets
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    assert creations(cluster) == before
    session = Session.objects.get()
    made_id = session.launcher_state[WARM]
    assert (session.state, session.launcher_state["pod"]) == ("ready", pod_name(Kind.WARM, made_id))
    assert session.address.startswith("wss://")
    secret = cluster.object("secrets", pod_name(Kind.WARM, made_id))
    assert secret["stringData"]["token"] == writes.manager_token(session) == writes.token_of(key_of(session))
    assert pods.running() == [], "the sweep of sessions does not know warm pods"
    end_orphans()
    session.refresh_from_db()
    assert session.state == "ready"
    api.delete(f"sessions/{started['id']}")
    pool.keep_warm()
    assert pod_name(Kind.WARM, made_id) not in cluster.names("pods"), "it is not given back"
    assert WarmExecutor.objects.filter(claimed_by=None).count() == 2


@pytest.mark.simulation
def test_a_real_warm_manager_takes_the_token_of_its_session(api, project, pods, cluster, tmp_path):
    with Node(tmp_path) as node:
        cluster.node = node.run
        pool.keep_warm()
        started = api.post(f"projects/{project['id']}/session")
        launched(started["id"])
        assert len(node.processes) == 2  # those that were warm, and no other
        session = Session.objects.get()
        assert asyncio.run(first_message(session))["command"] == "introspection"


async def first_message(session):
    async with manager_socket(session, "control") as opened:
        return json.loads(await opened.recv())


def test_each_executor_has_one_session_and_the_next_finds_none(pods):
    pool.keep_warm()
    found = [claim(uuid4(), pods) for _ in range(3)]
    assert found[2] is None
    assert found[0].state[WARM] != found[1].state[WARM]


def test_a_session_gets_none_that_another_server_has_just_taken(pods, monkeypatch):
    pool.keep_warm()
    other, poll = uuid4(), pods.poll

    def taken_meanwhile(state):
        WarmExecutor.objects.update(claimed_by=other)
        return poll(state)

    monkeypatch.setattr(pods, "poll", taken_meanwhile)
    assert claim(uuid4(), pods) is None


def test_an_executor_that_has_ended_is_passed_over(pods, cluster):
    pool.keep_warm()
    first, second = WarmExecutor.objects.order_by("created_at")
    name = pod_name(Kind.WARM, str(first.id))
    cluster.set_status(name, phase="Failed", conditions=[])
    pods._pods.wait(name, lambda seen: seen.exit_status is not None, time.monotonic() + 60)
    assert claim(uuid4(), pods).state[WARM] == str(second.id)


def test_a_session_of_a_launcher_without_warm_executors_claims_none(fake_manager):
    WarmExecutor.objects.create(created_at="2026-01-01T00:00Z", address="127.0.0.1:1")
    assert claim(uuid4(), fake_manager("echo")) is None
