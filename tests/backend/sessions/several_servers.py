"""Two real web servers that share PostgreSQL, Redis and a cluster, and nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import psycopg
import requests

from backend.sessions.lease import CARE
from tests.backend.services import free_port, postgresql, redis
from tests.backend.serving import REPOSITORY, Served, serving
from tests.benchmarks.load import settings_of, sign_in
from tests.e2e.observer import Observer
from tests.fakes.kubernetes_api import NAMESPACE, FakeCluster
from tests.fakes.kubernetes_node import kubeconfig

if TYPE_CHECKING:
    import signal
    from contextlib import ExitStack
    from pathlib import Path


class Team:
    """Two servers with folders of their own, and one account that is signed in."""

    def __init__(self, stack: ExitStack, folder: Path, cluster: FakeCluster, public_url: str = "") -> None:
        self.database = stack.enter_context(postgresql(fsync="off"))
        services = {
            "BT_STUDIO_DATABASE_URL": self.database,
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        config = folder / "kubeconfig"
        config.write_text(kubeconfig(cluster.url))
        settings, _ = settings_of(services)
        self.public_url = public_url or settings["BT_STUDIO_PUBLIC_URL"]
        settings["BT_STUDIO_PUBLIC_URL"] = self.public_url
        self._settings = settings | {
            "KUBECONFIG": str(config),
            "BT_STUDIO_LAUNCHER": "kubernetes",
            "BT_STUDIO_POD_TEMPLATE": str(REPOSITORY / "docker/kubernetes/executor-pod.yaml"),
            "BT_STUDIO_TOOLS_TEMPLATE": str(REPOSITORY / "docker/kubernetes/tools-pod.yaml"),
            "BT_STUDIO_POD_NAMESPACE": NAMESPACE,
            "BT_STUDIO_SESSION_START_TIMEOUT_S": "60",
            "BT_STUDIO_WORKERS": "1",
        }
        self._stack = stack
        self.ports = [free_port(), free_port()]
        self._folders = [folder / "first", folder / "second"]
        for own in self._folders:
            own.mkdir()
        self.servers = [self._serve(number) for number in (0, 1)]
        self.first = 0
        ((_, self.cookie),) = sign_in(self._folders[0], settings, 1)

    def _serve(self, number: int) -> Served:
        own = serving(self._folders[number], "--port", str(self.ports[number]), **self._settings)
        return self._stack.enter_context(own)

    def end(self, number: int, how: signal.Signals) -> None:
        self.servers[number].end(how)

    def begin_again(self, number: int) -> None:
        self.servers[number] = self._serve(number)

    def call(self, number: int, method: str, path: str, body: Any = None, key: str = "") -> Any:
        base = self.servers[number].base
        headers = {"Origin": base, "Cookie": self.cookie} | ({"Idempotency-Key": key} if key else {})
        address = f"{base}/api/v1/{path}"
        return requests.request(method, address, json=body, headers=headers, timeout=60)

    def try_twice(self, method: str, path: str, body: Any, key: str) -> Any:
        """Asks the preferred server, then the other; returns the last answer, or why there is none."""
        answer: Any = ""
        for number in (self.first, 1 - self.first):
            try:
                answer = self.call(number, method, path, body, key)
            except requests.RequestException as error:
                answer = repr(error)
                continue
            if answer.status_code < 500:
                return answer
        return answer

    def watch(self, number: int, session: str) -> Observer:
        return Observer.join(self.servers[number].base, self.cookie, session)

    def lease(self) -> tuple[str, Any]:
        """The owner of the lease for the sessions, and its end."""
        with psycopg.connect(self.database) as connection:
            rows = connection.execute(
                "SELECT owner, until FROM executor_sessions_lease WHERE name = %s", [CARE]
            )
            found = rows.fetchone()
            return ("", None) if found is None else (found[0], found[1])
