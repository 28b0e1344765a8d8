"""A real session whose processes are stopped (SIGSTOP): it records the reports and the final state."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import time
from dataclasses import dataclass

import psutil

from executor.session.ladder import HAS_APPLICATION, State
from tests.executor.session_client import SessionClient, manager_process, run_data
from tests.executor.warm import warm_session
from tests.processes import with_word

CHILDREN = ("world", "application")
CASES = [(kind, state) for state in State for kind in CHILDREN]
"""A world or an application that is stopped; below its rung it is the spare that waits to be used."""
_IN_USE = {
    "world": [state for state in State if state.reaches(State.UNIVERSE_READY)],
    "application": sorted(HAS_APPLICATION),
}
ROOT = {"tree_id": "MainTree", "node_id": "n1"}
"""A breakpoint at the root of the example."""
_LEFT = {"world": State.CONNECTED, "application": State.VISUALIZATION_READY}


@dataclass
class Outcome:
    """The reports after one process was stopped; times count from then."""

    victim: str
    state: State
    fault: dict
    reported_s: float
    right_s: float


class HangingSession:
    """One manager with one client; `stop_child` may be called repeatedly."""

    def __init__(self, manager, client):
        self.manager = manager
        self.client = client
        self.run = run_data()

    def child(self, kind):
        """Returns the living process of a kind, or None."""
        found = with_word(f"executor.{kind}.process", psutil.Process(self.manager.pid).children())
        return found[0] if found else None

    async def spare(self, kind, *, other_than=0):
        """Waits until there is a process of a kind."""
        async with asyncio.timeout(60):
            while True:
                found = self.child(kind)
                if found is not None and found.pid != other_than:
                    return found
                await asyncio.sleep(0.02)

    async def climb(self, state):
        """Climbs or descends to a state."""
        await self.ask("disconnect")
        stops = [ROOT] if state is State.HELD else []
        await self.ask("set_breakpoints", {"breakpoints": stops})
        universe, application = self.run["universe"], self.run["application"]
        for command, data, rung in [
            ("connect", None, State.CONNECTED),
            ("launch_universe", universe, State.UNIVERSE_READY),
            ("prepare_visualization", None, State.VISUALIZATION_READY),
            ("run_application", application, State.APPLICATION_RUNNING),
            ("pause", None, State.PAUSED),
        ]:
            if state is State.HELD and rung is State.PAUSED:
                at = len(self.client.events)
                await self.client.until(lambda: self.client.state == State.HELD)
                assert self.client.named("fault", after=at) == []
            elif list(State).index(rung) <= list(State).index(state):
                await self.ask(command, data)
        if state is State.IDLE:
            await self.ask("connect")  # it starts the spares again, which remain
        assert self.client.state == (State.CONNECTED if state is State.IDLE else state)

    async def ask(self, command, data=None):
        """Sends a command that must succeed."""
        reply = await self.client.ask(command, data, timeout_s=120)
        assert reply == "ack", (command, reply)

    async def stop_child(self, kind, state):
        """Climbs, stops a process, and waits until the session has reported and replaced it."""
        await self.climb(state)
        is_used = state in _IN_USE[kind]
        victim = await self.spare(kind)
        at, began_s = len(self.client.events), time.monotonic()
        os.kill(victim.pid, signal.SIGSTOP)
        fault = await self.client.event("fault", after=at)
        async with asyncio.timeout(120):
            if is_used:
                await self.client.event("state-changed", lambda d: d["state"] == _LEFT[kind], after=at)
            await self.spare(kind, other_than=victim.pid)
            while victim.is_running():  # noqa: ASYNC110 - the process table
                await asyncio.sleep(0.02)
        right_s = time.monotonic() - began_s
        outcome = Outcome(kind, state, fault["data"], fault["at"] - began_s, right_s)
        assert fault["data"]["kind"] == "timeout", outcome
        assert "its process is stopped" in fault["data"]["message"], outcome
        assert ("waiting" in fault["data"]["message"]) is not is_used, outcome
        assert len(self.client.named("fault", after=at)) == 1, outcome
        return outcome

    async def runs(self):
        """Runs the application, and waits until it ticks."""
        at = len(self.client.events)
        await self.ask("run", self.run)
        await self.client.event("tick", lambda d: d["n"] > 3, after=at)


@contextlib.asynccontextmanager
async def hanging_session():
    """Opens a session that other tests use, too."""
    async with warm_session(stream=False) as (manager, client):
        yield HangingSession(manager, client)


@contextlib.asynccontextmanager
async def own_hanging_session():
    """Opens a session of its own."""
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open(stream=False)
        yield HangingSession(manager, client)
        await client.close()
