"""Two real web servers that share PostgreSQL, Redis and a cluster, and nothing else."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import psycopg
import requests

from tests.backend.programs import sign_in
from tests.backend.services import cluster as postgresql_server
from tests.backend.services import free_port, redis_server
from tests.backend.serving import REPOSITORY, TIMEOUT_S, Served, serving
from tests.benchmarks.load import settings_of
from tests.e2e.observer import Observer
from tests.fakes.kubernetes_api import NAMESPACE, FakeCluster
from tests.fakes.kubernetes_node import kubeconfig

if TYPE_CHECKING:
    import signal
    from contextlib import ExitStack
    from pathlib import Path


DRIVEN_S = 0.5


class Team:
    """Two servers with folders of their own, and accounts that are signed in.

    Attributes:
        cookies: of each account.
        cookie: that of the first one, with which `call` asks.
        repositories: from which each server is started the next time.
    """

    def __init__(
        self,
        stack: ExitStack,
        folder: Path,
        cluster: FakeCluster,
        public_url: str = "",
        *,
        people: int = 1,
        repository: Path = REPOSITORY,
        database_url: str = "",
    ) -> None:
        self.repositories = [repository, repository]
        self.database = database_url
        if not database_url:  # many sockets and savers at once
            self.postgresql = stack.enter_context(postgresql_server(fsync="off", max_connections=120))
            self.database = self.postgresql.url
        self.redis = stack.enter_context(redis_server())
        services = {"BT_STUDIO_DATABASE_URL": self.database, "BT_STUDIO_REDIS_URL": self.redis.url}
        config = folder / "kubeconfig"
        config.write_text(kubeconfig(cluster.url))
        settings, _ = settings_of(services)
        self.public_url = public_url or settings["BT_STUDIO_PUBLIC_URL"]
        settings["BT_STUDIO_PUBLIC_URL"] = self.public_url
        self.settings = settings | {
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
        self.cookies = [cookie for _, cookie in sign_in(self._folders[0], settings, people)]
        self.cookie = self.cookies[0]

    def _serve(self, number: int) -> Served:
        folder = self._folders[number]
        log = self._stack.enter_context((folder / "server.log").open("ab"))
        own = serving(
            folder,
            "--port",
            str(self.ports[number]),
            log=log,
            repository=self.repositories[number],
            **self.settings,
        )
        return self._stack.enter_context(own)

    def end(self, number: int, how: signal.Signals) -> None:
        self.servers[number].end(how)

    def begin_again(self, number: int) -> None:
        self.servers[number] = self._serve(number)

    def call(  # noqa: PLR0917 - the parts of a request
        self, number: int, method: str, path: str, body: Any = None, key: str = "", cookie: str = ""
    ) -> Any:
        base = self.servers[number].base
        headers = {"Origin": base, "Cookie": cookie or self.cookie}
        headers |= {"Idempotency-Key": key} if key else {}
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

    def watch(self, number: int, session: str, cookie: str = "") -> Observer:
        return Observer.join(self.servers[number].base, cookie or self.cookie, session)

    def lease(self) -> tuple[str, Any]:
        """The owner of the lease for the sessions, and its end."""
        from backend.sessions.lease import CARE  # needs Django

        with psycopg.connect(self.database) as connection:
            rows = connection.execute(
                "SELECT owner, until FROM executor_sessions_lease WHERE name = %s", [CARE]
            )
            found = rows.fetchone()
            return ("", None) if found is None else (found[0], found[1])


def await_motion(observer: Observer) -> None:
    """Waits until the robot has driven further."""
    observer.wait_for_sim_time(observer.sim_time() + DRIVEN_S, TIMEOUT_S)
    end_s = time.monotonic() + TIMEOUT_S
    while observer.distance_travelled("robot") < 0.002:
        assert time.monotonic() < end_s
        time.sleep(0.05)
