"""A session whose pod is a real manager with TLS, as the template starts it."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import json
import os
import random
import socket
import subprocess
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

import pytest
from django.core.exceptions import ImproperlyConfigured

from backend.sessions import writes
from backend.sessions.launchers.kubernetes.bodies import PORT
from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher, open_cluster
from backend.sessions.manager.address import http_connection
from backend.sessions.manager.sockets import manager_socket
from backend.sessions.models import Session
from tests.backend.sessions.launchers.kubernetes.conftest import TEMPLATE
from tests.backend.sessions.test_writes import launched
from tests.docker.engine import REPOSITORY
from tests.fakes.kubernetes_api import NAMESPACE, READY, FakeCluster

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = [pytest.mark.django_db(transaction=True), pytest.mark.simulation]


KUBECONFIG = """
apiVersion: v1
kind: Config
current-context: fake
contexts: [{{name: fake, context: {{cluster: fake, user: fake}}}}]
clusters: [{{name: fake, cluster: {{server: "{url}"}}}}]
users: [{{name: fake, user: {{token: a token}}}}]
"""


class Node:
    """Runs the container of a pod as a process at an address of its own on this machine."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        parts = (random.randint(1, 254) for _ in range(3))  # noqa: S311 - no secret
        self.address = ".".join(("127", *map(str, parts)))
        self.processes: list[subprocess.Popen[bytes]] = []

    def run(self, cluster: FakeCluster, pod: dict[str, Any]) -> None:
        container, name = pod["spec"]["containers"][0], pod["metadata"]["name"]
        secret = cluster.object("secrets", container["env"][0]["valueFrom"]["secretKeyRef"]["name"])[
            "stringData"
        ]
        for item in pod["spec"]["volumes"][0]["secret"]["items"]:
            (self._folder / item["path"]).write_text(secret[item["key"]])
        mount = container["volumeMounts"][0]["mountPath"]
        arguments = [
            argument.replace("--host=0.0.0.0", f"--host={self.address}").replace(mount, str(self._folder))
            for argument in container["args"]
        ]
        environment = {**os.environ, container["env"][0]["name"]: secret["token"]}
        process = subprocess.Popen(
            [sys.executable, "-m", "executor.manager", *arguments], cwd=REPOSITORY, env=environment
        )
        self.processes.append(process)
        self._await_port()
        cluster.set_status(name, phase="Running", podIP=self.address, conditions=[READY])
        threading.Thread(target=self._report, args=(cluster, name, process), daemon=True).start()

    def _await_port(self) -> None:
        end_s = time.monotonic() + 60
        while time.monotonic() < end_s:
            with contextlib.suppress(OSError), socket.create_connection((self.address, PORT), 1):
                return
            time.sleep(0.05)

    @staticmethod
    def _report(cluster: FakeCluster, name: str, process: subprocess.Popen[bytes]) -> None:
        state = {"terminated": {"exitCode": process.wait(), "reason": "Error"}}
        found = {"name": "executor", "image": "x", "imageID": "x", "ready": False, "restartCount": 0}
        if name in cluster.names("pods"):
            cluster.set_status(name, phase="Failed", containerStatuses=[found | {"state": state}])


@pytest.fixture
def node(cluster: FakeCluster, launcher: KubernetesLauncher, tmp_path: Path, monkeypatch):
    running = Node(tmp_path)
    cluster.node = running.run
    monkeypatch.setattr(writes, "launcher", lambda: launcher)
    yield running
    for process in running.processes:
        process.kill()
        process.wait()


async def introspection(session: Session) -> dict[str, Any]:
    async with manager_socket(session, "control") as opened:
        return json.loads(await opened.recv())


def test_a_session_in_a_pod_is_reached_and_its_end_is_noticed(api, project, node: Node) -> None:
    started = api.post(f"projects/{project['id']}/session")
    launched(started["id"])
    assert api.get(f"sessions/{started['id']}")["state"] == "ready"
    session = Session.objects.get()
    assert session.address.startswith(f"wss://{node.address}:{PORT}#")
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
    assert "status -9" in ended["error"]


def test_the_cluster_of_kubeconfig_is_used_over_connections_that_notice_their_loss(
    cluster: FakeCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = tmp_path / "config"
    config.write_text(KUBECONFIG.format(url=cluster.url))
    monkeypatch.setenv("KUBECONFIG", str(config))
    launcher = open_cluster(TEMPLATE, NAMESPACE)
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
    if isinstance(thing, socket.socket) and thing.family is socket.AF_INET and thing.fileno() >= 0:
        return thing
    return None


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
        open_cluster(file, "robots")


@pytest.mark.parametrize("lacking", ["current-context: fake\n", "user: fake"])
def test_a_kubeconfig_without_a_cluster_or_a_user_is_refused(
    lacking: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = tmp_path / "config"
    config.write_text(KUBECONFIG.format(url="http://127.0.0.1:1").replace(lacking, ""))
    monkeypatch.setenv("KUBECONFIG", str(config))
    with pytest.raises(ImproperlyConfigured, match=r"[Nn]o current context"):
        open_cluster(TEMPLATE, "robots")


def test_a_server_outside_of_any_cluster_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("KUBECONFIG", str(tmp_path / "missing"))
    with pytest.raises(ImproperlyConfigured, match="KUBECONFIG names none"):
        open_cluster(TEMPLATE, "robots")
