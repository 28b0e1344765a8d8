"""Requests to a cluster: repeated while it is busy, and refused with a reason."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import pytest

from backend.sessions.errors import LaunchError
from backend.sessions.launchers.kubernetes import asking
from backend.sessions.launchers.kubernetes.rayjob_bodies import RayJob
from tests.backend.sessions.conftest import spec
from tests.backend.sessions.launchers.kubernetes.conftest import client_of
from tests.fakes.kubernetes_api import EVALUATIONS

if TYPE_CHECKING:
    from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
    from tests.fakes.kubernetes_api import FakeCluster


def test_a_busy_cluster_is_asked_again(
    cluster: FakeCluster, launcher: KubernetesLauncher, monkeypatch: pytest.MonkeyPatch
) -> None:
    pauses: list[float] = []
    monkeypatch.setattr(asking, "sleep", pauses.append)
    cluster.busy = 2
    launcher.start(spec())
    assert pauses == [1.0, 1.0]
    cluster.busy = 10**6
    with pytest.raises(LaunchError, match="too many requests"):
        launcher.start(spec(session_id="s2", start_timeout_s=0.1))


def test_what_is_not_there_is_no_error_when_it_is_deleted(cluster: FakeCluster) -> None:
    client = client_of(cluster, EVALUATIONS)
    assert not asking.delete(client, RayJob, "nothing", 0.0)
    client.close()


def test_a_verb_that_the_role_has_not_is_refused_with_the_clusters_words(cluster: FakeCluster) -> None:
    client = client_of(cluster, "elsewhere")
    with pytest.raises(LaunchError, match="cannot create resource rayjobs"):
        asking.create(client, RayJob({"metadata": {"name": "a"}}), time.monotonic())
    client.close()
