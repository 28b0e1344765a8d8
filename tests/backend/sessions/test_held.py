"""A manager, a web server or a page that dies or is stopped while the debugger holds a tree."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import sys
import time
from typing import TYPE_CHECKING, Any

import psutil
import pytest
import requests
from websockets.asyncio.client import connect

from backend.sessions.consumers import EXECUTOR_SILENT
from tests.backend.serving import serving
from tests.budget import count
from tests.executor.hanging import ROOT
from tests.executor.session_client import SessionClient, run_data
from tests.processes import with_word

if TYPE_CHECKING:
    from tests.backend.serving import Served

pytestmark = pytest.mark.simulation

HERE = {"state": "held", "uid": 1}
STOPPED_S = 6.0
"""The seconds for which a web server is stopped; after half of it a page reports a silence."""


class Page(SessionClient):
    """A page that controls a session through the web server."""

    def __init__(self, server: Served, session: dict[str, Any]) -> None:
        super().__init__(server.port)
        self.headers = server.headers
        self.url = f"ws{server.base.removeprefix('http')}{session['control_url']}"

    def _connect(self, path: str) -> connect:
        query = path.partition("?")[2]
        url = self.url if not query else f"{self.url}{'&' if '?' in self.url else '?'}{query}"
        return connect(url, additional_headers=self.headers, max_size=None, compression=None, proxy=None)


class HeldRun:
    """A project on a real server, and its session whose tree is held.

    Attributes:
        page: the one that controls the session.
        manager: the process of the session.
        family: the manager and all below it.
    """

    def __init__(self, server: Served) -> None:
        self.use(server)
        self.project = self.ask("POST", "projects", json={"template": "laser_bump_and_go"})["id"]

    def use(self, server: Served) -> None:
        """Continues with another server of the same data."""
        self.server = server
        self.api = requests.Session()
        self.api.headers.update(server.headers)

    def ask(self, method: str, path: str, **more: Any) -> Any:
        """Asks the server's API."""
        answer = self.api.request(method, f"{self.server.base}/api/v1/{path}", timeout=100, **more)
        assert answer.ok, answer.text
        return answer.json()

    async def hold(self) -> None:
        """Opens a session of the project, and waits until its tree is held."""
        self.session = await asyncio.to_thread(self.ask, "POST", f"projects/{self.project}/session")
        self.page = await Page(self.server, self.session).open(stream=False)
        assert await self.page.ask("set_breakpoints", {"breakpoints": [ROOT]}) == "ack"
        assert await self.page.ask("run", run_data()) == "ack"
        await self.page.event("held")
        children = psutil.Process(self.server.process.pid).children()
        [self.manager] = with_word("executor.manager", children)
        self.family = [self.manager, *self.manager.children(recursive=True)]

    async def is_held(self) -> None:
        """Checks by another page that the tree is held, and that who takes over continues it."""
        async with asyncio.timeout(60):
            other = await Page(self.server, self.session).open(stream=False)
            snapshot = (await other.event("snapshot"))["data"]
        assert {"state": snapshot["state"], "uid": snapshot["held"]["uid"]} == HERE
        assert await other.ask("take_over") == "ack"
        at = len(other.events)
        assert await other.ask("continue_run") == "ack"
        await other.event("held", after=at)
        assert other.named("fault") == []
        await other.close()

    async def has_ended(self, state: str) -> None:
        """Waits until the server says how the session has ended."""
        async with asyncio.timeout(60):
            while (found := await asyncio.to_thread(self.look))["state"] != state:
                assert found["state"] == "ready", found
                await asyncio.sleep(0.05)  # asks the server again

    def look(self) -> dict[str, Any]:
        """The session, as the server has it."""
        found: dict[str, Any] = self.ask("GET", f"sessions/{self.session['id']}")
        return found

    async def leaves_nothing(self) -> None:
        """Waits until the processes of the session have ended; who reaps them may be late."""
        async with asyncio.timeout(60):
            while any(runs(each) for each in self.family):  # noqa: ASYNC110 - the process table
                await asyncio.sleep(0.01)

    async def end(self) -> None:
        """Ends the session and waits for its processes."""
        await asyncio.to_thread(self.ask_to_end)
        await self.leaves_nothing()

    def ask_to_end(self) -> None:
        """Ends the session."""
        url = f"{self.server.base}/api/v1/sessions/{self.session['id']}"
        assert self.api.delete(url, timeout=100).ok


def runs(process: psutil.Process) -> bool:
    """Whether a process has not ended."""
    try:
        return bool(process.is_running() and process.status() != psutil.STATUS_ZOMBIE)
    except psutil.NoSuchProcess:
        return False


def tell(what: str, began_s: float) -> None:
    """Prints after how long all was right."""
    sys.stdout.write(f"{what}: right after {time.monotonic() - began_s:.2f} s\n")


async def kill_manager(run: HeldRun) -> None:
    began_s = time.monotonic()
    run.manager.kill()
    await run.has_ended("failed")
    await run.leaves_nothing()
    tell("manager killed", began_s)


async def kill_page(run: HeldRun) -> None:
    began_s = time.monotonic()
    run.page.control.transport.abort()
    await run.is_held()
    tell("page killed", began_s)


@pytest.mark.kills
async def test_who_is_killed_while_the_tree_is_held_leaves_it_held_or_ended_and_nothing_behind(tmp_path):
    kinds = ["manager", "page", "web server"]
    number, run = 0, None
    while number < count("held_server_kills"):
        with serving(tmp_path) as server:
            run = run or HeldRun(server)
            run.use(server)
            while number < count("held_server_kills"):
                kind, number = kinds[number % len(kinds)], number + 1
                if kind == "manager":
                    await run.hold()
                    await kill_manager(run)
                elif kind == "page":
                    await run.hold()
                    await kill_page(run)
                else:  # the session that the page has left
                    began_s = time.monotonic()
                    server.process.kill()
                    server.process.wait()
                    await run.leaves_nothing()
                    tell("web server killed", began_s)
                    break
        if kind == "web server":
            with serving(tmp_path) as server:
                run.use(server)
                assert run.look()["state"] in {"ended", "failed"}
                await run.hold()  # another session of the project can be held at once
                await run.end()


async def stop_manager(run: HeldRun) -> None:
    began_s = time.monotonic()
    run.manager.suspend()
    await run.page.control.wait_closed()
    assert run.page.control.close_code == EXECUTOR_SILENT
    assert "did not answer" in run.page.control.close_reason
    await run.has_ended("failed")
    await run.leaves_nothing()
    tell("manager stopped", began_s)


async def stop_page(run: HeldRun) -> None:
    began_s = time.monotonic()
    run.page.control.transport.pause_reading()
    await run.is_held()
    tell("page stopped", began_s)
    run.page.control.transport.resume_reading()
    await run.page.event("held", after=len(run.page.events) - 1)
    await run.end()


async def stop_web_server(run: HeldRun) -> None:
    os.kill(run.server.process.pid, signal.SIGSTOP)
    try:
        asked = asyncio.create_task(run.page.ask("ping"))
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(asyncio.shield(asked), STOPPED_S)  # this silence is what a page reports
        assert not asked.done()
    finally:
        os.kill(run.server.process.pid, signal.SIGCONT)
    began_s = time.monotonic()
    assert await asked == "ack"
    assert run.page.state == "held"
    await run.is_held()
    tell("web server continued", began_s)
    await run.end()


@pytest.mark.kills
async def test_who_is_stopped_while_the_tree_is_held_is_given_up_or_found_as_it_was(tmp_path):
    stops = [stop_manager, stop_page, stop_web_server]
    with serving(tmp_path) as server:
        run = HeldRun(server)
        for number in range(count("held_server_stops")):
            await run.hold()
            await stops[number % len(stops)](run)
