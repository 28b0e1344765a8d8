"""A rolling upgrade by hand: `python -m tests.backend.sessions.two_releases CHECKOUT [BACKUP]`.

CHECKOUT is a checkout of the release before. Two of its web servers run on one PostgreSQL and one Redis,
while people save and sessions of both kinds run. Each is replaced in turn by one of this release, which
migrates the database while the other one serves on. At each step sessions are started and looked at through
both servers.
With BACKUP the release before writes a backup there first, and this release restores it at the end.

The suite has no checkout of that release; what it keeps is `tests/backend/test_previous_release.py`.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Final

from tests.backend.serving import REPOSITORY, TIMEOUT_S
from tests.backend.sessions.crowd import Crowd, Editor, Listener, Page
from tests.backend.sessions.several_servers import Team, await_motion
from tests.e2e.server import wait_until
from tests.fakes.kubernetes_api import FakeCluster
from tests.fakes.kubernetes_node import Node

if TYPE_CHECKING:
    from collections.abc import Sequence

EDITORS: Final = 12
FIRST_SESSIONS: Final = 4
FAKE: Final = (str(REPOSITORY / "tests/fakes/manager.py"), "echo")


class Upgrade:
    """People at two servers, and what they see."""

    def __init__(self, team: Team, node: Node, crowd: Crowd) -> None:
        self.team, self.node, self.crowd = team, node, crowd
        self.editors = [Editor(crowd, number, cookie) for number, cookie in enumerate(team.cookies)]
        self.listeners = [Listener(editor) for editor in self.editors]
        self.pages: list[Page] = []

    def begin(self) -> None:
        """Opens the projects, and lets all save."""
        self.crowd.do_all(*(editor.open() for editor in self.editors))
        for person in self.editors:
            self.crowd.begin(person.save_for_ever())
        for listener in self.listeners:
            self.crowd.begin(listener.listen_for_ever())

    def start(self, number: int, *, is_real: bool) -> None:
        """Starts the session of an editor, at the server that this one prefers."""
        page = Page(self.editors[number], is_real=is_real)
        self.node.instead = () if is_real else FAKE
        self.pages.append(page)
        self.crowd.begin(page.look_for_ever())
        self.crowd.do(page.run())
        if is_real:
            self.crowd.do(page.drive())

    def look(self, what: str) -> None:
        """Waits until all have saved, heard and been answered once more."""
        since_s = monotonic()

        def is_right() -> bool:
            assert not self.crowd.broken, self.crowd.broken
            assert [page.reason for page in self.pages] == [None] * len(self.pages)
            return (
                all(each.began_s > since_s for each in self.editors)
                and all(each.answered_s > since_s for each in self.pages)
                and all(each.heard_s > since_s for each in self.listeners)
            )

        wait_until(is_right, what, deadline_s=TIMEOUT_S)
        for page in self.pages:
            for server in (0, 1):
                cookie = page.editor.cookie
                found = self.team.call(server, "GET", f"sessions/{page.session}", cookie=cookie)
                assert found.ok, (server, found.text)
                if page.is_real:
                    observer = self.team.watch(server, page.session, cookie)
                    await_motion(observer)
                    observer.close()
        saves = sum(len(editor.acknowledged) for editor in self.editors)
        repeated = dict(self.crowd.repeated)
        sys.stdout.write(f"{what}: {saves} saves, {len(self.pages)} sessions, repeated {repeated}\n")
        sys.stdout.flush()

    def replace(self, number: int, how: signal.Signals) -> None:
        """Replaces a server of the release before by one of this release."""
        self.team.end(number, how)
        self.team.repositories[number] = REPOSITORY
        self.team.begin_again(number)

    def end(self) -> None:
        """Ends all sessions through the other server than they were started at, and looks for all saves."""
        for page in self.pages:
            server = 1 - page.editor.number % 2
            ended = self.team.call(server, "DELETE", f"sessions/{page.session}", cookie=page.editor.cookie)
            assert ended.status_code == 204, ended.text
        lost = self.crowd.do_all(*(editor.lost() for editor in self.editors))
        assert [each for found in lost for each in found] == []
        saves = sum(len(editor.acknowledged) for editor in self.editors)
        sys.stdout.write(f"all {saves} acknowledged saves are there\n")


def keep(verb: str, file: Path, data: Path, repository: Path, settings: dict[str, str]) -> None:
    """Writes a backup of a server's data, or restores one, with the program of a release."""
    command = [sys.executable, "-m", "backend.cli.main", verb, str(file)]
    own = {"BT_STUDIO_DATA_DIR": str(data), "PYTHONPATH": str(repository)}
    subprocess.run(command, cwd=repository, env=os.environ | settings | own, check=True)


def main(checkout: Path, backup: Sequence[str]) -> None:
    """Upgrades two servers."""
    with ExitStack() as stack:
        folder = Path(tempfile.mkdtemp())
        sys.stdout.write(f"what the servers say: {folder}/*/server.log\n")
        (folder / "node").mkdir()
        node = stack.enter_context(Node(folder / "node"))
        node.repository = checkout
        cluster = stack.enter_context(FakeCluster(node.run))
        team = Team(stack, folder, cluster, people=EDITORS, repository=checkout)
        upgrade = Upgrade(team, node, stack.enter_context(Crowd(team.ports)))
        upgrade.begin()
        for number in range(FIRST_SESSIONS):
            upgrade.start(number, is_real=number == 0)
        upgrade.look("two servers of the release before")
        for place in backup:
            keep("backup", Path(place).absolute(), folder / "first", checkout, team.settings)
        upgrade.replace(0, signal.SIGTERM)
        upgrade.look("one of each")
        node.repository = REPOSITORY
        for number in range(FIRST_SESSIONS, FIRST_SESSIONS + 2):
            upgrade.start(number, is_real=number == FIRST_SESSIONS)
        upgrade.look("one of each, and sessions that each has started")
        upgrade.replace(1, signal.SIGKILL)
        upgrade.look("two servers of this release")
        upgrade.end()
    for place in backup:
        keep("restore", Path(place).absolute(), folder / "restored", REPOSITORY, {})


if __name__ == "__main__":
    main(Path(sys.argv[1]).absolute(), sys.argv[2:3])
