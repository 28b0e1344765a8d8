"""A node of the fake cluster, which runs the containers of pods as real processes on this machine."""

from __future__ import annotations

import contextlib
import os
import random
import signal
import socket
import subprocess
import sys
import threading
import time
from typing import TYPE_CHECKING, Any, Self

from backend.sessions.launchers.kubernetes.bodies import PORT
from tests.docker.engine import REPOSITORY
from tests.fakes.kubernetes_api import READY, FakeCluster

if TYPE_CHECKING:
    from pathlib import Path

_STARTS_IN_S = 60
_CONFIG = """
apiVersion: v1
kind: Config
current-context: fake
contexts: [{{name: fake, context: {{cluster: fake, user: fake}}}}]
clusters: [{{name: fake, cluster: {{server: "{url}"}}}}]
users: [{{name: fake, user: {{token: a token}}}}]
"""


def kubeconfig(url: str) -> str:
    """The text of a file for `KUBECONFIG`."""
    return _CONFIG.format(url=url)


class Node:
    """Runs the container of each pod as a process, at an address of its own on this machine.

    Attributes:
        instead: what Python runs in place of the container's program, if anything.
        process_of: the process of each pod, by the name of the pod.
        repository: where the programs of new containers are.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.instead: tuple[str, ...] = ()
        self.addresses: list[str] = []
        self.processes: list[subprocess.Popen[bytes]] = []
        self.process_of: dict[str, subprocess.Popen[bytes]] = {}
        self.repository = REPOSITORY

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for process in self.processes:
            process.kill()
            process.wait()

    def run(self, cluster: FakeCluster, pod: dict[str, Any]) -> None:
        container, name = pod["spec"]["containers"][0], pod["metadata"]["name"]
        address = ".".join(("127", *(str(random.randint(1, 254)) for _ in range(3))))  # noqa: S311 - no secret
        self.addresses.append(address)
        secret = cluster.object("secrets", container["env"][0]["valueFrom"]["secretKeyRef"]["name"])[
            "stringData"
        ]
        files = self._folder / name
        files.mkdir(exist_ok=True)
        for item in pod["spec"]["volumes"][0]["secret"]["items"]:
            (files / item["path"]).write_text(secret[item["key"]])
        mount = container["volumeMounts"][0]["mountPath"]
        arguments = [
            argument.replace("--host=0.0.0.0", f"--host={address}").replace(mount, str(files))
            for argument in container["args"]
        ]
        environment = {**os.environ, container["env"][0]["name"]: secret["token"]}
        environment["PYTHONPATH"] = str(self.repository)
        program = self.instead or container.get("command", ["python", "-m", "executor.manager"])[1:]
        process = subprocess.Popen(
            [sys.executable, *program, *arguments], cwd=self.repository, env=environment
        )
        self.processes.append(process)
        self.process_of[name] = process
        _await_port(address)
        cluster.set_status(name, phase="Running", podIP=address, conditions=[READY])
        threading.Thread(target=self._report, args=(cluster, name, process), daemon=True).start()
        cluster.when_removed(name, lambda: process.send_signal(signal.SIGTERM))

    @staticmethod
    def _report(cluster: FakeCluster, name: str, process: subprocess.Popen[bytes]) -> None:
        state = {"terminated": {"exitCode": process.wait(), "reason": "Error"}}
        found = {"name": "executor", "image": "x", "imageID": "x", "ready": False, "restartCount": 0}
        if name in cluster.names("pods"):
            cluster.set_status(name, phase="Failed", containerStatuses=[found | {"state": state}])


def _await_port(address: str) -> None:
    end_s = time.monotonic() + _STARTS_IN_S
    while time.monotonic() < end_s:
        with contextlib.suppress(OSError), socket.create_connection((address, PORT), 1):
            return
        time.sleep(0.05)
