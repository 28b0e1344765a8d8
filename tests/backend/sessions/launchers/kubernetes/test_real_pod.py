"""A session whose pod is a real manager with TLS, as the template starts it."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import json
import socket
import time
from typing import TYPE_CHECKING, Any, cast

import pytest
from django.core.exceptions import ImproperlyConfigured

from backend.sessions.launchers.kubernetes.bodies import PORT
from backend.sessions.launchers.kubernetes.launcher import Files, KubernetesLauncher, open_cluster
from backend.sessions.lifecycle import writes
from backend.sessions.manager.address import http_connection
from backend.sessions.manager.sockets import manager_socket
from backend.sessions.models import Session
from tests.backend.sessions.launchers.kubernetes.conftest import TEMPLATE, TOOLS_TEMPLATE
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.fakes.kubernetes_api import NAMESPACE, FakeCluster
from tests.fakes.kubernetes_node import Node, kubeconfig

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = [pytest.mark.django_db(transaction=True), pytest.mark.simulation]


@pytest.fixture
def node(cluster: FakeCluster, launcher: KubernetesLauncher, tmp_path: Path, monkeypatch):
    with Node(tmp_path) as running:
        cluster.node = running.run
        monkeypatch.setattr(writes, "launcher", lambda: launcher)
        yield running


async def introspection(session: Session) -> dict[str, Any]:
    async with manager_socket(session, "control") as opened:
        return json.loads(await opened.recv())


def test_a_session_in_a_pod_is_reached_and_its_end_is_noticed(api, project, node: Node) -> None:
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    assert api.get(f"sessions/{started['id']}")["state"] == "ready"
    session = Session.objects.get()
    assert session.address.startswith(f"wss://{node.addresses[0]}:{PORT}#")
    assert asyncio.run(introspection(session))["command"] == "introspection"
    connection = http_connection(session.address, 20)
    connection.request("GET", "/health", headers={"Authorization": f"Bearer {writes.manager_token(session)}"})
    with connection.getresponse() as answer:
        assert json.loads(answer.read())["state"] == "idle"
    connection.close()
    node.processes[0].kill()
    end_s = time.monotonic() + 20
    while api.get(f"sessions/{started['id']}")["state"] == "ready":
        assert time.monotonic() < end_s
        time.sleep(0.05)
    ended = api.get(f"sessions/{started['id']}")
    assert ended["state"] == "failed"
    assert "ended by itself" in ended["error"]


def test_the_cluster_of_kubeconfig_is_used_over_connections_that_notice_their_loss(
    cluster: FakeCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = tmp_path / "config"
    config.write_text(kubeconfig(cluster.url))
    monkeypatch.setenv("KUBECONFIG", str(config))
    launcher = open_cluster(Files(TEMPLATE, TOOLS_TEMPLATE), NAMESPACE)
    try:
        assert launcher._pods.wait("none", lambda _: launcher._pods.are_listed, time.monotonic() + 20)[1]
        ours = [found for found in map(socket_of, gc.get_objects()) if found and to(found) == cluster.port]
        assert ours
        assert all(found.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE) for found in ours)
        assert all(found.getsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE) == 15 for found in ours)
    finally:
        cluster.die()
        launcher.close()


def socket_of(thing: object) -> socket.socket | None:
    # The type and not isinstance, which asks a weak proxy for the class of what it stands for, gone or not.
    if not issubclass(type(thing), socket.socket):
        return None
    found = cast("socket.socket", thing)
    return found if found.family is socket.AF_INET and found.fileno() >= 0 else None


def to(found: socket.socket) -> int:
    with contextlib.suppress(OSError):
        return int(found.getpeername()[1])
    return 0


@pytest.mark.parametrize(
    ("template", "sentence"),
    [(None, "BT_STUDIO_POD_TEMPLATE: .* cannot be used"), ("a: 1", "one pod"), ("", "one pod")],
)
def test_settings_that_cannot_work_are_refused_by_name(
    tmp_path: Path, template: str | None, sentence: str
) -> None:
    file = tmp_path / "pod.yaml"
    if template is not None:
        file.write_text(template)
    with pytest.raises(ImproperlyConfigured, match=sentence):
        open_cluster(Files(file, TOOLS_TEMPLATE), "robots")


def test_a_file_that_is_no_pod_of_tools_is_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(ImproperlyConfigured, match=r"BT_STUDIO_TOOLS_TEMPLATE: .* cannot be used"):
        open_cluster(Files(TEMPLATE, tmp_path / "missing.yaml"), "robots")


@pytest.mark.parametrize("lacking", ["current-context: fake\n", "user: fake"])
def test_a_kubeconfig_without_a_cluster_or_a_user_is_refused(
    lacking: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = tmp_path / "config"
    config.write_text(kubeconfig("http://127.0.0.1:1").replace(lacking, ""))
    monkeypatch.setenv("KUBECONFIG", str(config))
    with pytest.raises(ImproperlyConfigured, match=r"[Nn]o current context"):
        open_cluster(Files(TEMPLATE, TOOLS_TEMPLATE), "robots")


def test_a_server_outside_of_any_cluster_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("KUBECONFIG", str(tmp_path / "missing"))
    with pytest.raises(ImproperlyConfigured, match="KUBECONFIG names none"):
        open_cluster(Files(TEMPLATE, TOOLS_TEMPLATE), "robots")
