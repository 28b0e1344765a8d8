"""Sessions in pods: each way to start and to end, with the reason that the user reads."""

from __future__ import annotations

import hashlib
import re
import ssl
import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import httpx2
import pytest
from lightkube import Client

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes import launcher as module
from backend.sessions.launchers.kubernetes import objects
from backend.sessions.launchers.kubernetes.bodies import Kind, pod_name
from tests.backend.sessions.conftest import spec
from tests.deadline import DEADLINE_S, wait_until
from tests.fakes.kubernetes_api import make_ready

if TYPE_CHECKING:
    from collections.abc import Callable

    from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
    from tests.fakes.kubernetes_api import FakeCluster

NAME = pod_name(Kind.SESSION, "s1")


def until(launcher: KubernetesLauncher, state: dict[str, Any], status: int | None) -> None:
    wait_until(lambda: launcher.poll(state) == status, f"{status}", every_s=0.01)


def waiting(reason: str, message: str = "") -> dict[str, Any]:
    state = {"waiting": {"reason": reason, "message": message}}
    return {"containerStatuses": [{"name": "executor", "image": "x", "imageID": "", "ready": False,
                                   "restartCount": 0, "state": state}]}  # fmt: skip


def terminated(status: int, reason: str = "Error") -> dict[str, Any]:
    state = {"terminated": {"exitCode": status, "reason": reason}}
    return {"containerStatuses": [{"name": "executor", "image": "x", "imageID": "", "ready": False,
                                   "restartCount": 0, "state": state}]}  # fmt: skip


def condition(kind: str, status: str, reason: str, message: str = "") -> dict[str, Any]:
    return {"conditions": [{"type": kind, "status": status, "reason": reason, "message": message}]}


def test_a_session_starts_with_a_secret_of_its_own_and_ends(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    started = launcher.start(spec())
    assert cluster.names("pods") == cluster.names("secrets") == [NAME]
    secret, pod = cluster.object("secrets", NAME), cluster.object("pods", NAME)
    assert secret["stringData"]["token"] == "t0ken"
    assert secret["metadata"]["ownerReferences"][0]["uid"] == pod["metadata"]["uid"] == started.state["uid"]
    der = ssl.PEM_cert_to_DER_cert(secret["stringData"]["tls.crt"])
    assert started.address == f"wss://127.0.0.1:7163#{hashlib.sha256(der).hexdigest()}"
    assert "t0ken" not in str(started) + str(pod)
    assert NAME in str(pod["spec"]["containers"][0]["env"])
    assert launcher.poll(started.state) is None
    assert launcher.running() == ["s1"]
    assert launcher.state_of("s1")["pod"] == started.state["pod"]
    launcher.stop(started.state, timeout_s=1)
    assert cluster.names("pods") == cluster.names("secrets") == []
    launcher.stop(started.state, timeout_s=1)  # again is no error
    assert launcher.running() == []


def test_a_hundred_sessions_start_at_once(cluster: FakeCluster, launcher: KubernetesLauncher) -> None:
    """No pod gets ready before all are made, as where images are pulled first."""
    pods: list[dict[str, Any]] = []

    def node(_: FakeCluster, pod: dict[str, Any]) -> None:
        pods.append(pod)
        if len(pods) >= 100:
            for each in pods:
                make_ready(cluster, each)

    cluster.node, cluster.validates = node, False
    with ThreadPoolExecutor(launcher.starts_at_once) as threads:
        specs = [spec(session_id=f"s{n}", start_timeout_s=DEADLINE_S) for n in range(100)]
        started = list(threads.map(launcher.start, specs))
    assert len({each.state["pod"] for each in started}) == 100


def test_only_the_verbs_of_the_role_are_used(cluster: FakeCluster, launcher: KubernetesLauncher) -> None:
    started = launcher.start(spec())
    launcher.running()
    launcher.stop(started.state, timeout_s=0)
    assert {verb for verb, _ in cluster.asked} <= {"create", "get", "list", "watch", "delete"}


@pytest.mark.parametrize(
    ("status", "sentence"),
    [
        (
            waiting("ImagePullBackOff", "no such tag"),
            r"image of the session cannot be pulled. \(no such tag\)",
        ),
        (waiting("InvalidImageName"), "image of the session cannot be pulled"),
        ({"phase": "Failed", **terminated(137, "OOMKilled")}, "more memory than it may have"),
        ({"phase": "Failed", **terminated(3)}, r"ended before it was ready"),
        (
            {"phase": "Failed", "reason": "Evicted", "message": "low on disk"},
            r"keep its node alive. \(low on disk\)",
        ),
        (waiting("CreateContainerConfigError", "no key"), r"cannot be made. \(no key\)"),
        ({"phase": "Running"}, "not ready within 1 s"),
    ],
)
def test_a_pod_that_does_not_start_says_why_and_leaves_nothing(
    cluster: FakeCluster, launcher: KubernetesLauncher, status: dict[str, Any], sentence: str
) -> None:
    cluster.node = lambda of, pod: of.set_status(pod["metadata"]["name"], **status)
    with pytest.raises(LaunchError, match=sentence):
        launcher.start(spec(start_timeout_s=1))
    assert cluster.names("pods") == cluster.names("secrets") == []


def test_a_cluster_without_room_lets_the_session_wait(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    unschedulable = condition("PodScheduled", "False", "Unschedulable", "0/3 nodes are available")
    cluster.node = lambda of, pod: of.set_status(pod["metadata"]["name"], **unschedulable)
    with pytest.raises(
        HostFullError, match=re.escape("no room for another session now. (0/3 nodes are available)")
    ):
        launcher.start(spec(start_timeout_s=1))
    assert cluster.names("pods") == []


def test_a_used_up_quota_lets_the_session_wait(cluster: FakeCluster, launcher: KubernetesLauncher) -> None:
    cluster.quota = 0
    with pytest.raises(HostFullError, match="used up their part of the cluster"):
        launcher.start(spec())


def test_a_pod_of_the_session_that_has_not_gone_yet_is_left_alone(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    launcher.start(spec())
    with pytest.raises(HostFullError, match="has not ended yet"):
        launcher.start(spec())
    assert cluster.names("pods") == [NAME]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (("spec", {"hostNetwork": True}), "violates PodSecurity"),
        (("container", {"image": ""}), "Required value"),
    ],
)
def test_what_the_cluster_refuses_is_said(
    cluster: FakeCluster, launcher: KubernetesLauncher, change: tuple[str, dict[str, Any]], sentence: str
) -> None:
    where, fields = change
    pod = launcher._templates[Kind.SESSION]["spec"]
    (pod if where == "spec" else pod["containers"][0]).update(fields)
    with pytest.raises(LaunchError, match=sentence):
        launcher.start(spec())
    assert cluster.names("pods") == []


def test_a_cluster_that_does_not_answer_is_said_and_ends_no_session(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    started = launcher.start(spec())
    cluster.is_dead = True
    with pytest.raises(LaunchError, match="does not answer"):
        launcher.start(spec(session_id="s2"))
    assert launcher.poll(started.state) is None
    assert launcher.running() == []


def test_a_pod_that_was_made_although_the_answer_was_lost_is_deleted(
    cluster: FakeCluster, launcher: KubernetesLauncher, monkeypatch: pytest.MonkeyPatch
) -> None:
    create: Callable[[Client, Any], Any] = Client.create

    def lost(client: Client, body: Any) -> None:
        create(client, body)
        raise httpx2.ReadTimeout("timed out")

    monkeypatch.setattr(Client, "create", lost)
    with pytest.raises(LaunchError, match="does not answer: timed out"):
        launcher.start(spec())
    assert cluster.names("pods") == []


@pytest.mark.parametrize(
    ("status", "exit_status", "sentence"),
    [
        (
            {"phase": "Failed", **terminated(137, "OOMKilled")},
            137,
            "The session took more memory than it may have.",
        ),
        ({"phase": "Succeeded", **terminated(0, "Completed")}, 0, ""),
        (
            {"phase": "Failed", "reason": "Evicted", "message": "low on memory"},
            UNKNOWN_EXIT,
            "The cluster ended the session, to keep its node alive. (low on memory)",
        ),
        (
            {"phase": "Failed", "reason": "DeadlineExceeded"},
            UNKNOWN_EXIT,
            "The session reached the longest time that it may run.",
        ),
        (
            {"phase": "Failed", "reason": "NodeLost"},
            UNKNOWN_EXIT,
            "The machine on which the session ran is gone.",
        ),
        (
            {"phase": "Failed", **condition("DisruptionTarget", "True", "PreemptionByScheduler")},
            UNKNOWN_EXIT,
            "The cluster gave the session's place to something more important.",
        ),
    ],
)
def test_each_end_has_its_reason_which_stays_when_the_pod_is_gone(
    cluster: FakeCluster,
    launcher: KubernetesLauncher,
    status: dict[str, Any],
    exit_status: int,
    sentence: str,
) -> None:
    state = launcher.start(spec()).state
    cluster.set_status(NAME, **status)
    until(launcher, state, exit_status)
    assert launcher.explain(state) == sentence
    assert launcher.running() == []
    cluster.remove("pods", NAME)
    with launcher._pods._changed:
        launcher._pods._changed.wait_for(lambda: NAME not in launcher._pods._living, 20)
    assert (launcher.poll(state), launcher.explain(state)) == (exit_status, sentence)


def test_a_pod_that_somebody_deletes_ends_its_session(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    state = launcher.start(spec()).state
    cluster.remove("pods", NAME)
    until(launcher, state, UNKNOWN_EXIT)
    assert launcher.explain(state) == "Somebody deleted the session in the cluster."


def test_a_pod_on_a_lost_node_has_ended_although_it_is_still_there(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    state = launcher.start(spec()).state
    cluster.object("pods", NAME)["metadata"]["deletionTimestamp"] = "2026-01-01T00:00:00Z"
    cluster.set_status(NAME, **condition("DisruptionTarget", "True", "DeletionByTaintManager"))
    until(launcher, state, UNKNOWN_EXIT)
    assert launcher.explain(state) == "The machine on which the session ran is gone."


def test_the_pod_of_another_server_counts_as_running_until_it_is_surely_unknown(
    launcher: KubernetesLauncher, monkeypatch: pytest.MonkeyPatch
) -> None:
    state = {"pod": pod_name(Kind.SESSION, "other")}
    launcher._pods.wait("none", lambda _: launcher._pods.are_listed, time.monotonic() + 20)
    assert launcher.poll(state) is None
    monkeypatch.setattr(objects, "UNKNOWN_S", -1.0)
    assert launcher.poll(state) == UNKNOWN_EXIT


def test_a_pod_without_end_is_killed(cluster: FakeCluster, launcher: KubernetesLauncher, monkeypatch) -> None:
    state = launcher.start(spec()).state
    asked = []
    delete = cluster.delete

    def hanging(kind, name, grace_s):
        asked.append(grace_s)
        return delete(kind, name, grace_s) if grace_s == 0 else cluster.object(kind, name)

    monkeypatch.setattr(module, "LAST_GRACE_S", 0.0)
    monkeypatch.setattr(cluster, "delete", hanging)
    launcher.stop(state, timeout_s=0.2)
    assert asked == [1.0, 0.0]
    assert cluster.names("pods") == []
