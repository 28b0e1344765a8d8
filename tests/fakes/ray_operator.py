"""A KubeRay operator that runs the programs of RayJobs as real processes, each beside a real Ray cluster."""

from __future__ import annotations

import os
import random
import secrets
import subprocess
import sys
import threading
from typing import TYPE_CHECKING, Any, Self

from tests.docker.engine import REPOSITORY
from tests.fakes import kuberay

if TYPE_CHECKING:
    from pathlib import Path

    from tests.fakes.kubernetes_api import FakeCluster

_CLUSTER = """
import sys
from executor.evaluation.cluster.ray_pool import import_ray, patiently

import_ray(is_own=False)
from ray.cluster_utils import Cluster

cluster = Cluster()
patiently(lambda: cluster.add_node(num_cpus=1, object_store_memory=100 << 20, include_dashboard=False))
print(cluster.address, flush=True)
sys.stdin.read()
cluster.shutdown()
"""


class RayOperator:
    """Makes what a RayJob asks for on this machine, and ends it with the RayJob."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.programs: list[subprocess.Popen[bytes]] = []
        self.clusters: list[subprocess.Popen[bytes]] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for program in self.programs:
            program.kill()
            program.wait()
        for cluster in self.clusters:
            cluster.communicate()

    def run(self, cluster: FakeCluster, job: dict[str, Any]) -> None:
        name = job["metadata"]["name"]
        cluster.set_status(name, "rayjobs", jobDeploymentStatus="Initializing")
        access = {"RAY_AUTH_MODE": "token", "RAY_AUTH_TOKEN": secrets.token_hex(32)}
        made = subprocess.Popen(
            [sys.executable, "-c", _CLUSTER],
            cwd=REPOSITORY,
            env={**os.environ, **access},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        self.clusters.append(made)
        assert made.stdout is not None
        ray_address = made.stdout.readline().decode().strip()
        address = ".".join(("127", *(str(random.randint(1, 254)) for _ in range(3))))  # noqa: S311 - no secret
        program = self._start(cluster, job, address, {**access, "RAY_ADDRESS": ray_address})
        self.programs.append(program)
        cluster.when_removed(name, program.terminate)
        cluster.set_status(name, "rayjobs", **kuberay.running(address))
        threading.Thread(target=self._report, args=(cluster, name, program), daemon=True).start()

    def _start(
        self, cluster: FakeCluster, job: dict[str, Any], address: str, more: dict[str, str]
    ) -> subprocess.Popen[bytes]:
        """Starts the entry point as Ray does on the head: by a shell, with its environment and files."""
        head = kuberay.pods_of(job)[0]["spec"]
        (container,) = head["containers"]
        secret = cluster.object("secrets", job["metadata"]["name"])["stringData"]
        given = {
            each["name"]: each["value"]
            if "value" in each
            else secret[each["valueFrom"]["secretKeyRef"]["key"]]
            for each in container["env"]
        }
        mount = next(each["mountPath"] for each in container["volumeMounts"] if each["name"] == "session")
        files = self._folder / job["metadata"]["name"]
        files.mkdir()
        volume = next(each for each in head["volumes"] if each["name"] == "session")
        for item in volume["secret"]["items"]:
            (files / item["path"]).write_text(secret[item["key"]])
        command = job["spec"]["entrypoint"].replace("exec python ", f"exec {sys.executable} ")
        command = command.replace("--host=0.0.0.0", f"--host={address}").replace(mount, str(files))
        environment = {**os.environ, **given, "PYTHONPATH": str(REPOSITORY), **more}
        return subprocess.Popen(command, shell=True, cwd=REPOSITORY, env=environment)  # noqa: S602 - our own template

    @staticmethod
    def _report(cluster: FakeCluster, name: str, program: subprocess.Popen[bytes]) -> None:
        status = program.wait()
        if name in cluster.names("rayjobs"):
            end = {"jobStatus": "FAILED", "jobDeploymentStatus": "Failed", "reason": "AppFailed"}
            done = {"jobStatus": "SUCCEEDED", "jobDeploymentStatus": "Complete"}
            cluster.set_status(name, "rayjobs", **(end if status else done))
