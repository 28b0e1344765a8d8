"""Evaluations as RayJobs: each way to start and to end, with the reason that the user reads."""

from __future__ import annotations

import contextlib
import re
import socket
import time
from typing import TYPE_CHECKING, Any

import pytest
from django.core.exceptions import ImproperlyConfigured

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes import rayjobs as module
from backend.sessions.launchers.kubernetes.bodies import PORT, Kind, pod_name
from backend.sessions.launchers.kubernetes.launcher import Files, read_settings
from backend.sessions.launchers.kubernetes.rayjob_bodies import (
    RayJob,
    rayjob_name,
    read_job_template,
    read_rayjob,
)
from backend.sessions.launchers.kubernetes.rayjobs import RayJobs
from tests.backend.sessions.conftest import spec
from tests.backend.sessions.launchers.kubernetes.conftest import (
    JOB_TEMPLATE,
    TEMPLATE,
    TOOLS_TEMPLATE,
    client_of,
)
from tests.fakes import kuberay
from tests.fakes.kubernetes_api import ALLOWED_OF_EVALUATIONS, EVALUATIONS, FakeCluster

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher

NAME = rayjob_name("s1")
HEAD = "127.7.1.9"


@pytest.fixture(autouse=True)
def head(cluster: FakeCluster) -> Iterator[socket.socket]:
    """The head of each Ray cluster: something listens at its manager's port."""

    def start(of: FakeCluster, job: dict[str, Any]) -> None:
        of.set_status(job["metadata"]["name"], "rayjobs", **kuberay.running(HEAD))

    cluster.operator = start
    with socket.create_server((HEAD, PORT)) as listener:
        yield listener


def evaluation(**more: Any) -> Any:
    return spec(own_cluster=True, **more)


def until(launcher: KubernetesLauncher, state: dict[str, Any], status: int) -> None:
    end_s = time.monotonic() + 20
    while launcher.poll(state) != status:
        assert time.monotonic() < end_s
        time.sleep(0.01)


def test_an_evaluation_starts_as_one_rayjob_with_its_secret_and_policy_and_ends(
    cluster: FakeCluster, clusters: KubernetesLauncher
) -> None:
    started = clusters.start(evaluation())
    assert cluster.names("rayjobs") == cluster.names("secrets") == cluster.names("networkpolicies") == [NAME]
    assert cluster.names("pods") == []
    job, secret = cluster.object("rayjobs", NAME), cluster.object("secrets", NAME)
    assert secret["stringData"]["token"] == "t0ken"
    assert "t0ken" not in str(started) + str(job)
    for kind in ("secrets", "networkpolicies"):
        (owner,) = cluster.object(kind, NAME)["metadata"]["ownerReferences"]
        assert (owner["kind"], owner["uid"]) == ("RayJob", job["metadata"]["uid"])
        assert cluster.object(kind, NAME)["metadata"]["namespace"] == EVALUATIONS
    digest = job["metadata"]["annotations"]["bt-studio/certificate"]
    assert started.address == f"wss://{HEAD}:{PORT}#{digest}"
    assert clusters.poll(started.state) is None
    assert clusters.running() == ["s1"]
    clusters.stop(started.state, timeout_s=1)
    assert not any(cluster.names(kind) for kind in ("rayjobs", "secrets", "networkpolicies"))
    clusters.stop(started.state, timeout_s=1)  # again is no error
    assert clusters.running() == []


def test_only_the_verbs_of_the_role_are_used(cluster: FakeCluster, clusters: KubernetesLauncher) -> None:
    started = clusters.start(evaluation())
    clusters.running()
    clusters.stop(started.state, timeout_s=0)
    of_sessions = {("list", "pods"), ("watch", "pods")}
    assert set(cluster.asked) - of_sessions <= ALLOWED_OF_EVALUATIONS


def test_what_needs_no_cluster_is_a_pod_as_before(cluster: FakeCluster, clusters: KubernetesLauncher) -> None:
    started = clusters.start(spec())
    assert (cluster.names("pods"), cluster.names("rayjobs")) == ([pod_name(Kind.SESSION, "s1")], [])
    clusters.start(evaluation(session_id="s2"))
    assert sorted(clusters.running()) == ["s1", "s2"]
    clusters.stop(started.state, timeout_s=0)
    assert clusters.running() == ["s2"]


def test_an_orphan_is_found_and_ended_by_its_id(cluster: FakeCluster, clusters: KubernetesLauncher) -> None:
    clusters.start(evaluation())
    (orphan,) = clusters.running()
    clusters.stop(clusters.state_of(orphan), timeout_s=0)
    assert cluster.names("rayjobs") == []


def condition(kind: str, status: str, reason: str, message: str) -> dict[str, Any]:
    found = {"type": kind, "status": status, "reason": reason, "message": message}
    times = {"lastTransitionTime": "2026-01-01T00:00:00Z"}
    return {"jobDeploymentStatus": "Initializing", "rayClusterStatus": {"conditions": [found | times]}}


@pytest.mark.parametrize(
    ("status", "sentence"),
    [
        (condition("HeadPodReady", "False", "ImagePullBackOff", "no tag"), r"cannot be pulled. \(no tag\)"),
        (
            condition("ReplicaFailure", "True", "FailedCreate", "violates x"),
            r"refuses the pods .* \(violates x\)",
        ),
        (
            {"jobDeploymentStatus": "ValidationFailed", "reason": "ValidationFailed", "message": "no head"},
            r"The KubeRay operator refuses the RayJob of the evaluation. \(no head\)",
        ),
        (
            {
                "jobDeploymentStatus": "Failed",
                "jobStatus": "FAILED",
                "reason": "AppFailed",
                "message": "exit 2",
            },
            r"program of the evaluation's RayJob failed. \(exit 2\)",
        ),
        ({"jobStatus": "STOPPED"}, "ended while it started"),
    ],
)
def test_a_rayjob_that_does_not_start_says_why_and_leaves_nothing(
    cluster: FakeCluster, clusters: KubernetesLauncher, status: dict[str, Any], sentence: str
) -> None:
    cluster.operator = lambda of, job: of.set_status(job["metadata"]["name"], "rayjobs", **status)
    with pytest.raises(LaunchError, match=sentence):
        clusters.start(evaluation(start_timeout_s=100))
    assert not any(cluster.names(kind) for kind in ("rayjobs", "secrets", "networkpolicies"))


@pytest.mark.parametrize(
    ("status", "sentence"),
    [
        ({}, "not ready within 9 s: the KubeRay operator has not taken it up: is it running, .*namespace?"),
        (
            {
                "jobDeploymentStatus": "Initializing",
                "rayClusterStatus": {"readyWorkerReplicas": 1, "desiredWorkerReplicas": 2},
            },
            "not ready within 9 s: 1 of 2 workers are ready",
        ),
    ],
)
def test_a_start_that_takes_too_long_says_what_it_waited_for(status: dict[str, Any], sentence: str) -> None:
    seen = read_rayjob(RayJob({"metadata": {"name": NAME}, "status": status}))
    assert re.search(sentence, str(module._not_started(seen, 9)))
    assert str(module._not_started(None, 9)).endswith("not ready within 9 s.")


def test_a_used_up_quota_lets_the_evaluation_wait(cluster: FakeCluster, clusters: KubernetesLauncher) -> None:
    status = condition("ReplicaFailure", "True", "FailedCreateHeadPod", "exceeded quota: cpu")
    cluster.operator = lambda of, job: of.set_status(job["metadata"]["name"], "rayjobs", **status)
    with pytest.raises(
        HostFullError, match=re.escape("no room for another session now. (exceeded quota: cpu)")
    ):
        clusters.start(evaluation(start_timeout_s=1))
    assert cluster.names("rayjobs") == []


def test_a_manager_that_does_not_listen_is_named(
    clusters: KubernetesLauncher, head: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "LOOK_S", 0.01)
    head.close()
    with pytest.raises(LaunchError, match="runs, but its manager was not reached within 1 s"):
        clusters.start(evaluation(start_timeout_s=1))


def test_a_manager_that_ends_before_it_listens_is_not_awaited(
    cluster: FakeCluster, clusters: KubernetesLauncher, head: socket.socket
) -> None:
    head.close()

    def fail(of: FakeCluster, job: dict[str, Any]) -> None:
        kuberay.make_running(of, job)
        with contextlib.suppress(KeyError):
            of.set_status(
                NAME, "rayjobs", jobDeploymentStatus="Failed", jobStatus="FAILED", reason="AppFailed"
            )

    cluster.operator = fail
    with pytest.raises(LaunchError, match="program of the evaluation's RayJob failed"):
        clusters.start(evaluation(start_timeout_s=100))


def test_a_cluster_without_kuberay_says_what_to_install(
    cluster: FakeCluster, clusters: KubernetesLauncher
) -> None:
    cluster.has_kuberay = False
    with pytest.raises(LaunchError, match="KubeRay operator is not installed") as found:
        clusters.start(evaluation())
    assert "install it" in found.value.hint
    assert "BT_STUDIO_EVALUATIONS=rayjob" in found.value.hint
    assert clusters.running() == []


def test_a_missing_namespace_is_named_with_what_to_apply(
    cluster: FakeCluster, clusters: KubernetesLauncher
) -> None:
    cluster.namespaces.remove(EVALUATIONS)
    with pytest.raises(LaunchError, match='namespaces "evaluations" not found') as found:
        clusters.start(evaluation())
    assert "docker/kubernetes-evaluations" in found.value.hint


def refusal(cluster: FakeCluster, change: Callable[[dict[str, Any]], None]) -> str:
    """Returns why a RayJob of a changed template does not start."""
    template = read_job_template(JOB_TEMPLATE.read_text())
    change(template.job["spec"])
    jobs = RayJobs(client_of(cluster, EVALUATIONS), template)
    try:
        with pytest.raises(LaunchError) as found:
            jobs.start("s1", "t0ken", 30)
    finally:
        cluster.die()
        jobs.close()
    assert cluster.names("rayjobs") == []
    return str(found.value)


def test_a_rayjob_that_kuberay_does_not_take_is_refused_with_the_reason(cluster: FakeCluster) -> None:
    assert "'backofLimit' was unexpected" in refusal(cluster, lambda job: job.update(backofLimit=3))


def test_a_pod_that_pod_security_refuses_is_refused_with_the_reason(cluster: FakeCluster) -> None:
    def change(job: dict[str, Any]) -> None:
        job["rayClusterSpec"]["workerGroupSpecs"][0]["template"]["spec"]["hostNetwork"] = True

    assert "violates PodSecurity" in refusal(cluster, change)


@pytest.mark.parametrize(
    ("status", "exit_status", "sentence"),
    [
        ({"jobDeploymentStatus": "Complete", "jobStatus": "SUCCEEDED"}, 0, ""),
        (
            {"jobDeploymentStatus": "Failed", "reason": "DeadlineExceeded"},
            UNKNOWN_EXIT,
            "The evaluation reached the longest time that its RayJob may run.",
        ),
        (
            {"jobDeploymentStatus": "Failed", "reason": "JobStatusCheckTimeoutExceeded", "message": "gone"},
            UNKNOWN_EXIT,
            "The KubeRay operator lost the evaluation's Ray cluster. (gone)",
        ),
    ],
)
def test_each_end_has_its_reason(
    cluster: FakeCluster,
    clusters: KubernetesLauncher,
    status: dict[str, Any],
    exit_status: int,
    sentence: str,
) -> None:
    state = clusters.start(evaluation()).state
    cluster.set_status(NAME, "rayjobs", **status)
    until(clusters, state, exit_status)
    assert clusters.explain(state) == sentence
    assert clusters.running() == ["s1"], "it is deleted by who maintains the sessions"


def test_a_rayjob_that_somebody_deletes_ends_its_evaluation(
    cluster: FakeCluster, clusters: KubernetesLauncher
) -> None:
    state = clusters.start(evaluation()).state
    cluster.remove("rayjobs", NAME)
    until(clusters, state, UNKNOWN_EXIT)
    assert clusters.explain(state) == "Somebody deleted the session in the cluster."


def test_a_cluster_that_does_not_answer_ends_no_evaluation(
    cluster: FakeCluster, clusters: KubernetesLauncher
) -> None:
    state = clusters.start(evaluation()).state
    cluster.is_dead = True
    assert clusters.poll(state) is None
    assert clusters.running() == []


def test_a_file_that_is_no_rayjob_is_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(ImproperlyConfigured, match=r"BT_STUDIO_RAYJOB_TEMPLATE: .* cannot be used"):
        read_settings(Files(TEMPLATE, TOOLS_TEMPLATE, tmp_path / "missing.yaml"))
    with pytest.raises(ImproperlyConfigured, match=r"BT_STUDIO_RAYJOB_TEMPLATE: .* one RayJob"):
        read_settings(Files(TEMPLATE, TOOLS_TEMPLATE, TEMPLATE))
