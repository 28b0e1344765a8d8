"""Twenty sessions and fifty editors at two web servers, while each kind of component is killed in turn.

Two sessions are real: managers, worlds and applications that drive. The managers of the others answer and do
nothing else. No acknowledged save may be lost. After the return of the component, or the kill of one that
does not return, each session must answer, or have ended with a reason; nobody else's session ends.

How long that took is printed and not asserted: two servers, robots and people compute on one machine.
`docs/explanation/reliability.md` has the figures.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from contextlib import ExitStack
from time import monotonic
from typing import TYPE_CHECKING, Final

import psutil
import pytest

from backend.sessions.launchers.kubernetes.bodies import Kind, pod_name
from tests.backend.serving import TIMEOUT_S
from tests.backend.sessions.crowd import Crowd, Editor, Listener, Page
from tests.backend.sessions.several_servers import Team, await_motion
from tests.budget import count
from tests.fakes.kubernetes_api import FakeCluster
from tests.fakes.kubernetes_node import Node
from tests.processes import with_word

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

BLOWS: Final = count("backend_chaos_blows")

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(0)]

EDITORS: Final = 50
SESSIONS: Final = 20
REAL: Final = 2
LISTENERS: Final = 10
FAKE: Final = ("tests/fakes/manager.py", "echo")
DOWN_S: Final = 2.0
STARTS_AT_ONCE: Final = 3


@pytest.fixture
def node(tmp_path: Path) -> Iterator[Node]:
    folder = tmp_path / "node"
    folder.mkdir()
    with Node(folder) as running:
        yield running


@pytest.fixture
def cluster(node: Node) -> Iterator[FakeCluster]:
    with FakeCluster(node.run) as running:
        yield running


@pytest.fixture
def team(tmp_path: Path, cluster: FakeCluster) -> Iterator[Team]:
    with ExitStack() as stack:
        yield Team(stack, tmp_path, cluster, people=EDITORS)


@pytest.fixture
def crowd(team: Team) -> Iterator[Crowd]:
    with Crowd(team.ports) as people:
        yield people


class Storm:
    """All that runs, and the ways to break it; each returns the pages whose session must end."""

    def __init__(self, team: Team, cluster: FakeCluster, node: Node, crowd: Crowd) -> None:
        self.team, self.cluster, self.node, self.crowd = team, cluster, node, crowd
        self.editors = [Editor(crowd, number, cookie) for number, cookie in enumerate(team.cookies)]
        self.listeners = [Listener(editor) for editor in self.editors[-LISTENERS:]]
        self.pages = [Page(each, is_real=each.number < REAL) for each in self.editors[:SESSIONS]]
        self.returned_s = 0.0
        self.took_s: dict[str, list[float]] = {}

    def begin(self) -> None:
        """Opens everything."""
        self.crowd.do_all(*(editor.open() for editor in self.editors))
        for page in self.pages:
            self.crowd.begin(page.look_for_ever())
        for page in self.pages[:REAL]:
            self.press_run(page)
        self.node.instead = FAKE
        for first in range(REAL, SESSIONS, STARTS_AT_ONCE):
            self.crowd.do_all(*(page.run() for page in self.pages[first : first + STARTS_AT_ONCE]))
        for editor in self.editors:
            self.crowd.begin(editor.save_for_ever())
        for listener in self.listeners:
            self.crowd.begin(listener.listen_for_ever())
        self.returned_s = monotonic()
        self.await_right("begin")

    def press_run(self, page: Page) -> None:
        """Starts the session of a page, with a real robot or a stand-in."""
        self.node.instead = () if page.is_real else FAKE
        self.crowd.do(page.run())
        if page.is_real:
            self.crowd.do(page.drive())

    def manager(self, page: Page) -> psutil.Process:
        """The process of a page's session."""
        return psutil.Process(self.node.process_of[pod_name(Kind.SESSION, page.session)].pid)

    def away(self, end: Callable[[], None], start: Callable[[], None]) -> list[Page]:
        """Ends a component, and starts it again after a while."""
        end()
        time.sleep(DOWN_S)  # the outage itself
        start()
        self.returned_s = monotonic()
        return []

    def kill_first_server(self) -> list[Page]:
        return self.away(lambda: self.team.end(0, signal.SIGKILL), lambda: self.team.begin_again(0))

    def kill_second_server(self) -> list[Page]:
        return self.away(lambda: self.team.end(1, signal.SIGKILL), lambda: self.team.begin_again(1))

    def end_first_server(self) -> list[Page]:
        return self.away(lambda: self.team.end(0, signal.SIGTERM), lambda: self.team.begin_again(0))

    def kill_redis(self) -> list[Page]:
        return self.away(lambda: self.team.redis.end(signal.SIGKILL), self.team.redis.start)

    def crash_postgresql(self) -> list[Page]:
        return self.away(self.team.postgresql.crash, self.team.postgresql.start)

    def cut_off_cluster(self) -> list[Page]:
        return self.away(self.cluster.die, self.cluster.revive)

    def kill_manager(self, page: Page) -> list[Page]:
        self.returned_s = monotonic()
        self.manager(page).kill()
        return [page]

    def kill_stand_in(self) -> list[Page]:
        return self.kill_manager(self.pages[-1])

    def kill_real_manager(self) -> list[Page]:
        return self.kill_manager(self.pages[0])

    def children(self, page: Page, program: str) -> list[psutil.Process]:
        """Processes that a manager has started, the oldest first: spares are younger."""
        found = with_word(program, self.manager(page).children())
        return sorted(found, key=psutil.Process.create_time)

    def kill_child(self, page: Page, program: str) -> list[Page]:
        """Kills what a manager has started, and not what it holds ready; starts the robot again."""
        used = self.children(page, program)[0]
        self.returned_s = monotonic()
        used.kill()
        self.wait_for(f"{program}: another state", lambda: page.state != "application_running")
        self.wait_for(f"{program}: the fault", lambda: any("ended at once" in each for each in page.faults))
        self.crowd.do(page.drive())
        return []

    def kill_world(self) -> list[Page]:
        return self.kill_child(self.pages[0], "executor.world.process")

    def kill_application(self) -> list[Page]:
        return self.kill_child(self.pages[1], "executor.application.process")

    def kill_recorder(self) -> list[Page]:
        """Kills the recorder of a robot that drives on."""
        page, program = self.pages[1], "executor.recorder.process"
        old = self.children(page, program)
        self.returned_s = monotonic()
        old[0].kill()
        self.wait_for(f"{program}: another", lambda: self.children(page, program) not in ([], old))
        return []

    def wait_for(self, what: str, is_so: Callable[[], bool]) -> None:
        """Waits for something, and notes how long that took from the return of the component."""
        end_s = monotonic() + TIMEOUT_S
        while not is_so():
            assert not self.crowd.broken, self.crowd.broken
            assert monotonic() < end_s, (what, [each.reason for each in self.pages])
            time.sleep(0.05)  # it looks again soon
        took_s = monotonic() - self.returned_s
        self.took_s.setdefault(what, []).append(took_s)
        sys.stdout.write(f"{what} after {took_s:.1f} s, load {os.getloadavg()[0]:.0f}\n")
        sys.stdout.flush()

    def await_right(self, blow: str, ended: list[Page] | None = None) -> None:
        """Waits until all are right again after a blow; the sessions of some pages must have ended."""
        since_s, gone = self.returned_s, ended or []
        left = [page for page in self.pages if page not in gone]
        self.wait_for(f"{blow}: saves", lambda: all(each.began_s > since_s for each in self.editors))
        self.wait_for(f"{blow}: sessions", lambda: all(each.answered_s > since_s for each in left))
        self.wait_for(f"{blow}: ends", lambda: all(each.reason is not None for each in gone))
        self.wait_for(f"{blow}: notices", lambda: all(each.heard_s > since_s for each in self.listeners))
        assert [each.reason for each in left] == [None] * len(left)
        assert all(each.reason for each in gone)
        for page in left:
            state = self.team.call(0, "GET", f"sessions/{page.session}", cookie=page.editor.cookie).json()
            assert state["state"] == "ready"
            if page.is_real:
                assert page.state == "application_running", (blow, page.faults)

    def await_robots(self) -> None:
        """Waits until both robots drive, as seen from each server."""
        for number, page in enumerate(self.pages[:REAL]):
            observer = self.team.watch(number, page.session, page.editor.cookie)
            await_motion(observer)
            observer.close()


def test_whatever_is_killed_no_save_is_lost_and_each_session_is_right_or_ended(
    team: Team, cluster: FakeCluster, node: Node, crowd: Crowd
) -> None:
    storm = Storm(team, cluster, node, crowd)
    storm.begin()
    blows = [
        *(storm.kill_redis, storm.crash_postgresql, storm.cut_off_cluster),
        *(storm.kill_stand_in, storm.kill_real_manager),
        *(storm.kill_world, storm.kill_application, storm.kill_recorder),
        *(storm.kill_first_server, storm.kill_second_server, storm.end_first_server),
    ]
    for number in range(max(1, BLOWS)):
        blow = blows[number % len(blows)]
        gone = blow()
        storm.await_right(blow.__name__, gone)
        for page in gone:
            storm.press_run(page)
        storm.await_robots()
        assert not crowd.broken
    lost = crowd.do_all(*(editor.lost() for editor in storm.editors))
    saves = sum(len(editor.acknowledged) for editor in storm.editors)
    sys.stdout.write(f"{saves} acknowledged saves; repeated: {dict(crowd.repeated)}\n")
    for what, took_s in storm.took_s.items():
        sys.stdout.write(f"  {what}: {', '.join(f'{each:.1f}' for each in took_s)} s\n")
    assert [each for found in lost for each in found] == []
