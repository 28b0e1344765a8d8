"""Pods with the tools of users: one for each user, whichever web server asks."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

import kubernetes_validate
import pytest

from backend.accounts.models import User
from backend.language import tools
from backend.sessions import maintenance
from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.kubernetes.bodies import Kind, pod_body, pod_name
from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
from backend.sessions.lifecycle import writes
from tests.backend.sessions.launchers.kubernetes.conftest import templates
from tests.fakes.kubernetes_api import VERSION
from tests.fakes.kubernetes_node import Node

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from lightkube import Client

    from tests.fakes.kubernetes_api import FakeCluster

NAME = pod_name(Kind.TOOLS, "u1")


@pytest.fixture
def other(cluster: FakeCluster, launcher: KubernetesLauncher, client: Client) -> Iterator[KubernetesLauncher]:
    """The launcher of another web server."""
    made = KubernetesLauncher(client, templates())
    yield made
    cluster.die()
    made.close()


def opened(launcher: KubernetesLauncher, timeout_s: float = 20) -> str:
    return launcher.open_tools("u1", "t0ken", timeout_s=timeout_s)


def test_the_pod_of_tools_is_what_kubernetes_takes() -> None:
    pod = pod_body(templates()[Kind.TOOLS], Kind.TOOLS, "u1", "d1")
    kubernetes_validate.validate(pod, VERSION, strict=True)
    assert pod["spec"]["containers"][0]["command"] == ["python", "-m", "executor.tools"]


def test_every_web_server_finds_the_same_tools_which_are_no_session(
    cluster: FakeCluster, launcher: KubernetesLauncher, other: KubernetesLauncher
) -> None:
    found: list[str] = []
    askers = [
        threading.Thread(target=lambda of: found.append(opened(of)), args=(one,))
        for one in (launcher, other, launcher, other)
    ]
    for asker in askers:
        asker.start()
    for asker in askers:
        asker.join()
    assert len(found) == 4
    assert len(set(found)) == 1
    assert cluster.names("pods") == cluster.names("secrets") == [NAME]
    assert cluster.object("secrets", NAME)["stringData"]["token"] == "t0ken"
    assert launcher.running() == []


@pytest.mark.parametrize("is_known", [True, False])
def test_tools_that_have_ended_are_started_again(
    cluster: FakeCluster, launcher: KubernetesLauncher, other: KubernetesLauncher, is_known: bool
) -> None:
    first = opened(launcher)
    uid = cluster.object("pods", NAME)["metadata"]["uid"]
    cluster.set_status(NAME, phase="Succeeded", conditions=[])
    assert opened(launcher if is_known else other) != first
    assert cluster.object("pods", NAME)["metadata"]["uid"] != uid


def test_tools_that_ended_are_removed_once_a_minute_and_others_stay(
    cluster: FakeCluster, launcher: KubernetesLauncher, monkeypatch: pytest.MonkeyPatch, db: None
) -> None:
    opened(launcher)
    monkeypatch.setattr(writes, "launcher", lambda: launcher)
    maintenance.maintain(is_for_orphans=True)
    assert cluster.names("pods") == [NAME]
    cluster.set_status(NAME, phase="Succeeded", conditions=[])
    maintenance.maintain(is_for_orphans=True)
    assert cluster.names("pods") == []


def test_tools_whose_web_server_died_before_they_had_a_secret_start_again(
    cluster: FakeCluster, launcher: KubernetesLauncher
) -> None:
    cluster.create("pods", pod_body(templates()[Kind.TOOLS], Kind.TOOLS, "u1", "d1"))
    with pytest.raises(LaunchError, match="not ready within 1 s"):
        opened(launcher, timeout_s=1)
    assert cluster.names("pods") == []
    assert opened(launcher).startswith("wss://")


def test_what_hinders_tools_is_said(cluster: FakeCluster, launcher: KubernetesLauncher) -> None:
    cluster.quota = 0
    with pytest.raises(HostFullError, match="used up"):
        opened(launcher)
    cluster.quota = 10
    waiting = {"waiting": {"reason": "ImagePullBackOff", "message": "no such tag"}}
    status = {
        "name": "tools",
        "image": "x",
        "imageID": "",
        "ready": False,
        "restartCount": 0,
        "state": waiting,
    }

    def cannot(of: FakeCluster, pod: dict[str, Any]) -> None:
        of.set_status(pod["metadata"]["name"], containerStatuses=[status])

    cluster.node = cannot
    with pytest.raises(LaunchError, match="cannot be pulled"):
        opened(launcher)
    assert cluster.names("pods") == []
    cluster.is_dead = True
    with pytest.raises(LaunchError, match="does not answer"):
        opened(launcher)


def test_real_tools_check_a_text_and_are_found_again_when_they_were_killed(
    cluster: FakeCluster, launcher: KubernetesLauncher, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tools, "launcher", lambda: launcher)
    monkeypatch.setattr(tools, "addresses", {})
    arguments = ["format", "--isolated", "--no-cache", "-"]
    with Node(tmp_path) as node:
        cluster.node = node.run
        for _ in range(2):
            assert tools.run_ruff(User(pk=1), arguments, "x = {  1:1 }\n") == (0, "x = {1: 1}\n")
            node.processes[-1].kill()
            node.processes[-1].wait()
        assert len(node.processes) == 2
