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

import pytest

from tests.backend.serving import TIMEOUT_S
from tests.backend.sessions.several_servers import Team, await_motion
from tests.budget import count
from tests.fakes.kubernetes_api import FakeCluster
from tests.fakes.kubernetes_node import Node

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.e2e.observer import Observer

pytestmark = [pytest.mark.kills, pytest.mark.simulation, pytest.mark.timeout(900)]
PATH = "notes.txt"
SAVES_BESIDE = 5
PAUSE_S = 0.02


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


@pytest.fixture
def node(tmp_path: Path) -> Iterator[Node]:
    folder = tmp_path / "node"
    folder.mkdir()
    with Node(folder) as running:
        yield running


@pytest.fixture
def team(tmp_path: Path, node: Node, database_url: str) -> Iterator[Team]:
    with FakeCluster(node.run) as cluster, ExitStack() as stack:
        yield Team(stack, tmp_path, cluster, database_url=database_url)


def drive(team: Team, project: str, session: str) -> Observer:
    """Starts the robot, as a page does."""
    app = team.call(0, "GET", f"projects/{project}/app").json()
    observer = team.watch(0, session)
    application = {name: app[name] for name in ("app_zip_base64", "tick_hz", "on_finish", "on_error")}
    observer.send("run", {"universe": {"universe": app["universe"]}, "application": application})
    await_motion(observer)
    return observer


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
