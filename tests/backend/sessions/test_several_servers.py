"""Two real web servers share PostgreSQL, Redis and a cluster, and nothing else.

Each is ended in turn while an editor saves and a robot drives: no acknowledged save is lost, and the robot
continues. The cluster is a stand-in for Kubernetes' API whose node runs real managers.
"""

from __future__ import annotations

import signal
import threading
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import psycopg
import pytest
import requests

from backend.sessions.lease import CARE
from tests.backend.services import postgresql, redis
from tests.backend.serving import REPOSITORY, TIMEOUT_S, Served, serving
from tests.benchmarks.load import settings_of, sign_in
from tests.budget import count
from tests.e2e.observer import Observer
from tests.fakes.kubernetes_api import NAMESPACE, FakeCluster
from tests.fakes.kubernetes_node import Node, kubeconfig

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(900)]
PATH = "notes.txt"
SAVES_BESIDE = 5
PAUSE_S = 0.02
DRIVEN_S = 0.5


class Editor:
    """Saves all the time, at one server; a request that fails is repeated once at the other."""

    def __init__(self, team: Team, project: str) -> None:
        self._team = team
        self._address = f"projects/{project}/changes"
        self._ending = threading.Event()
        self.acknowledged: list[tuple[int, str]] = []
        self.refused: list[str] = []
        self._thread = threading.Thread(target=self._save_for_ever)

    def __enter__(self) -> Editor:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ending.set()
        self._thread.join(TIMEOUT_S)

    def wait_for(self, more: int) -> None:
        """Waits for more acknowledged saves."""
        wanted, end_s = len(self.acknowledged) + more, time.monotonic() + TIMEOUT_S
        while len(self.acknowledged) < wanted:
            assert time.monotonic() < end_s, self.refused
            assert not self.refused
            time.sleep(0.01)

    def _save_for_ever(self) -> None:
        number = revision = 0
        while not self._ending.wait(PAUSE_S):
            number += 1
            content = f"line {number}"
            file = {"path": PATH, "base_revision": revision, "content": content}
            body = {"files": [file]}
            answer = self._team.try_twice("POST", self._address, body, f"save-{number}")
            if isinstance(answer, str) or answer.status_code != 200:
                self.refused.append(answer if isinstance(answer, str) else answer.text)
                return
            revision = answer.json()["revision"]
            self.acknowledged.append((revision, content))


class Team:
    """Two servers with folders of their own, and one account that is signed in."""

    def __init__(self, stack: ExitStack, folder: Path, cluster: FakeCluster) -> None:
        self.database = stack.enter_context(postgresql(fsync="off"))
        services = {
            "BT_STUDIO_DATABASE_URL": self.database,
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        config = folder / "kubeconfig"
        config.write_text(kubeconfig(cluster.url))
        settings, _ = settings_of(services)
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
        self._folders = [folder / "first", folder / "second"]
        for own in self._folders:
            own.mkdir()
        self.servers = [self._serve(own) for own in self._folders]
        self.first = 0
        ((_, self.cookie),) = sign_in(self._folders[0], settings, 1)

    def _serve(self, folder: Path) -> Served:
        return self._stack.enter_context(serving(folder, **self._settings))

    def end(self, number: int, how: signal.Signals) -> None:
        self.servers[number].end(how)

    def begin_again(self, number: int) -> None:
        self.servers[number] = self._serve(self._folders[number])

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


@pytest.fixture
def node(tmp_path: Path) -> Iterator[Node]:
    folder = tmp_path / "node"
    folder.mkdir()
    with Node(folder) as running:
        yield running


@pytest.fixture
def team(tmp_path: Path, node: Node) -> Iterator[Team]:
    with FakeCluster(node.run) as cluster, ExitStack() as stack:
        yield Team(stack, tmp_path, cluster)


def drive(team: Team, project: str, session: str) -> Observer:
    """Starts the robot, as a page does."""
    app = team.call(0, "GET", f"projects/{project}/app").json()
    observer = team.watch(0, session)
    application = {name: app[name] for name in ("app_zip_base64", "tick_hz", "on_finish", "on_error")}
    observer.send("run", {"universe": {"universe": app["universe"]}, "application": application})
    await_motion(observer)
    return observer


def await_motion(observer: Observer) -> None:
    """Waits until the robot has driven further."""
    observer.wait_for_sim_time(observer.sim_time() + DRIVEN_S, TIMEOUT_S)
    end_s = time.monotonic() + TIMEOUT_S
    while observer.distance_travelled("robot") < 0.002:
        assert time.monotonic() < end_s
        time.sleep(0.05)


def await_maintenance(team: Team) -> None:
    """Waits until the servers that are left have maintained the sessions, orphans included, once more."""
    before, end_s = team.lease(), time.monotonic() + TIMEOUT_S
    seen: set[Any] = set()
    while len(seen) < 3:  # taken, and renewed after a whole round
        owner, until = team.lease()
        if until not in {before[1], None}:
            seen.add((owner, until))
        assert time.monotonic() < end_s
        time.sleep(0.1)


def test_servers_that_end_in_turn_lose_no_save_and_no_robot(team: Team, node: Node) -> None:
    project = team.call(0, "POST", "projects", {"template": "laser_bump_and_go"}).json()["id"]
    session = team.call(0, "POST", f"projects/{project}/session").json()["id"]
    observer = drive(team, project, session)
    with Editor(team, project) as editor:
        editor.wait_for(SAVES_BESIDE)
        for turn in range(2 * count("backend_servers_in_turn")):
            how = signal.SIGKILL if turn % 4 in {0, 3} else signal.SIGTERM
            ending, other = turn % 2, 1 - turn % 2
            team.first = ending
            editor.wait_for(SAVES_BESIDE)
            time_before = observer.sim_time()
            team.end(ending, how)
            editor.wait_for(SAVES_BESIDE)
            observer.close()
            observer = team.watch(other, session)
            assert observer.events[0]["data"]["state"] == "application_running"
            await_motion(observer)
            assert observer.sim_time() > time_before
            await_maintenance(team)
            team.begin_again(ending)
    observer.close()
    assert not editor.refused
    assert len(node.processes) == 1
    assert node.processes[0].poll() is None
    for number in (0, 1):
        assert team.call(number, "GET", f"sessions/{session}").json()["state"] == "ready"
        text = team.call(number, "GET", f"projects/{project}/files/{PATH}").text
        assert text == editor.acknowledged[-1][1]
    for revision, content in editor.acknowledged:
        found = team.call(0, "GET", f"projects/{project}/revisions/{revision}/files/{PATH}")
        assert found.text == content
    assert team.call(1, "DELETE", f"sessions/{session}").status_code in {200, 204}
    assert node.processes[0].wait(TIMEOUT_S) is not None
