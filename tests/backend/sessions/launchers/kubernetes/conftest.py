"""A launcher on a fake cluster."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from lightkube import Client, KubeConfig
from lightkube.config.models import Cluster, User

from backend.sessions.launchers.kubernetes.bodies import Kind, read_template
from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
from backend.sessions.launchers.kubernetes.rayjob_bodies import read_job_template
from backend.sessions.launchers.kubernetes.rayjobs import RayJobs
from tests.docker.engine import REPOSITORY
from tests.fakes.kubernetes_api import EVALUATIONS, NAMESPACE, FakeCluster

if TYPE_CHECKING:
    from collections.abc import Iterator

TEMPLATE = REPOSITORY / "docker" / "kubernetes" / "executor-pod.yaml"
TOOLS_TEMPLATE = TEMPLATE.with_name("tools-pod.yaml")
JOB_TEMPLATE = REPOSITORY / "docker" / "kubernetes-evaluations" / "evaluation-rayjob.yaml"


def templates() -> dict[Kind, dict[str, Any]]:
    """Returns the templates that we ship."""
    files = {Kind.SESSION: TEMPLATE, Kind.TOOLS: TOOLS_TEMPLATE}
    return {kind: read_template(file.read_text()) for kind, file in files.items()}


@pytest.fixture
def cluster() -> Iterator[FakeCluster]:
    with FakeCluster() as running:
        yield running


def client_of(cluster: FakeCluster, namespace: str) -> Client:
    config = KubeConfig.from_one(user=User(token="a token"), cluster=Cluster(server=cluster.url))
    return Client(config=config, namespace=namespace)


@pytest.fixture
def client(cluster: FakeCluster) -> Client:
    return client_of(cluster, NAMESPACE)


@pytest.fixture
def launcher(cluster: FakeCluster, client: Client) -> Iterator[KubernetesLauncher]:
    made = KubernetesLauncher(client, templates())
    yield made
    cluster.die()  # a watch that waits for the next event is not interrupted otherwise
    made.close()


@pytest.fixture
def clusters(cluster: FakeCluster, client: Client) -> Iterator[KubernetesLauncher]:
    """A launcher that starts evaluations as RayJobs."""
    jobs = RayJobs(client_of(cluster, EVALUATIONS), read_job_template(JOB_TEMPLATE.read_text()))
    made = KubernetesLauncher(client, templates(), jobs)
    yield made
    cluster.die()
    made.close()
