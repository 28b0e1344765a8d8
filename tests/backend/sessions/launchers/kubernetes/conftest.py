"""A launcher on a fake cluster."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from lightkube import Client, KubeConfig
from lightkube.config.models import Cluster, User

from backend.sessions.launchers.kubernetes.bodies import read_template
from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
from tests.docker.engine import REPOSITORY
from tests.fakes.kubernetes_api import NAMESPACE, FakeCluster

if TYPE_CHECKING:
    from collections.abc import Iterator

TEMPLATE = REPOSITORY / "docker" / "kubernetes" / "executor-pod.yaml"


@pytest.fixture
def cluster() -> Iterator[FakeCluster]:
    with FakeCluster() as running:
        yield running


@pytest.fixture
def client(cluster: FakeCluster) -> Client:
    config = KubeConfig.from_one(user=User(token="a token"), cluster=Cluster(server=cluster.url))
    return Client(config=config, namespace=NAMESPACE)


@pytest.fixture
def launcher(cluster: FakeCluster, client: Client) -> Iterator[KubernetesLauncher]:
    made = KubernetesLauncher(client, read_template(TEMPLATE.read_text()))
    yield made
    cluster.die()  # a watch that waits for the next event is not interrupted otherwise
    made.close()
