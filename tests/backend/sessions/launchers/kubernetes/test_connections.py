"""Many robots that start at once: each waits for its pod without a connection to the database."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

import pytest
from django.db import connection

from backend.sessions.lifecycle import writes
from backend.sessions.models import Session
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.fakes.kubernetes_api import make_ready

if TYPE_CHECKING:
    from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
    from tests.fakes.kubernetes_api import FakeCluster

pytestmark = pytest.mark.django_db(transaction=True)
ROBOTS = 12


def connections() -> int:
    """Connections to the database; SQLite has none."""
    if connection.vendor != "postgresql":
        return 0
    with connection.cursor() as cursor:
        cursor.execute("SELECT count(*) FROM pg_stat_activity WHERE datname = current_database()")
        return int(cursor.fetchone()[0])


def test_robots_that_start_hold_one_connection_together(
    api, cluster: FakeCluster, launcher: KubernetesLauncher, monkeypatch: pytest.MonkeyPatch
) -> None:
    may_start = threading.Event()

    def node(of: FakeCluster, pod: dict[str, object]) -> None:
        may_start.wait(60)
        make_ready(of, pod)

    cluster.node = node
    monkeypatch.setattr(writes, "launcher", lambda: launcher)
    monkeypatch.setattr(writes, "workers", writes.workers.__wrapped__)
    threads = writes.workers()
    monkeypatch.setattr(writes, "workers", lambda: threads)
    before = connections()
    started = []
    for number in range(ROBOTS):
        project = api.post("projects", {"name": f"P{number}"}, expect=201)["id"]
        started.append(api.post(f"projects/{project}/session")["id"])
    end_s = time.monotonic() + 60
    while len(cluster.names("secrets")) < ROBOTS:
        assert time.monotonic() < end_s
        time.sleep(0.02)
    assert connections() <= before + 2  # the one of the locks, and perhaps one of this test's requests
    may_start.set()
    for session in started:
        launched(session)
    assert set(Session.objects.values_list("state", flat=True)) == {"ready"}
    threads.shutdown()
