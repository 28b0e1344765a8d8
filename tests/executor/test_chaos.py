"""Random kills, stalls and disconnects over the ladder: the state stays true, and nothing is left."""

from __future__ import annotations

import asyncio
import contextlib
import os
import random
import signal
import sys

import psutil

from executor.ladder import State
from tests.budget import count
from tests.executor.session_client import SessionClient
from tests.executor.test_server import FAKE, RUN, manager

COMMANDS = ["run", "pause", "resume", "terminate_application", "disconnect", "reset_world"]


def fakes():
    """The living children by kind of their place in the manager."""
    living = [p for p in psutil.Process().children() if p.status() != psutil.STATUS_ZOMBIE]
    return [p for p in living if FAKE in p.cmdline()]


class Storm:
    def __init__(self, it, chance):
        self.manager = it
        self.chance = chance
        self.client = None

    @property
    def session(self):
        return self.manager.session

    async def connect(self):
        self.client = await SessionClient(self.manager.port).open()

    async def kill(self):
        living = list(self.manager._supervisor._children.items())
        if not living:
            return
        (kind, number), victim = self.chance.choice(living)
        child = self.session.children.get(kind)
        is_used = child is not None and child.number == number and child.is_started
        at = len(self.client.events)
        with contextlib.suppress(ProcessLookupError):
            os.kill(victim.pid, signal.SIGKILL)
        if is_used and self.session.state.reaches(State.UNIVERSE_READY):
            # Whoever looks on is told what died, and of what.
            await self.client.event("fault", lambda d: "SIGKILL" in d["message"], after=at)

    async def stall(self):
        supervised = fakes()
        if supervised:
            victim = self.chance.choice(supervised)
            os.kill(victim.pid, signal.SIGSTOP)
            await asyncio.sleep(self.chance.random() * 0.2)
            with contextlib.suppress(ProcessLookupError):  # it was ended meanwhile, as stopped as it was
                os.kill(victim.pid, signal.SIGCONT)

    async def reconnect(self):
        await self.client.close()
        await self.connect()

    async def command(self):
        name = self.chance.choice(COMMANDS)
        await self.client.ask(name, RUN if name == "run" else None, timeout_s=30)

    async def is_true(self):
        """Waits until the ladder stands on living processes."""
        async with asyncio.timeout(20):
            while not self._is_consistent():  # noqa: ASYNC110 - it looks at the process table
                await asyncio.sleep(0.02)

    def _is_consistent(self):
        if self.session.state is State.IDLE or self.session.leaving:
            return not self.session.leaving
        started = {kind for kind, child in self.session.children.items() if child.is_started}
        needed = set()
        if self.session.state.reaches(State.UNIVERSE_READY):
            needed.add("world")
        if self.session.state in {State.APPLICATION_RUNNING, State.PAUSED}:
            needed.add("application")
        return needed <= started and len(fakes()) <= len(self.session.children)


async def test_the_session_survives_a_storm():
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    chance = random.Random(seed)  # noqa: S311
    async with manager() as it:
        storm = Storm(it, chance)
        await storm.connect()
        for _ in range(count("manager_chaos")):
            await asyncio.sleep(chance.random() * 0.1)
            await chance.choice([storm.kill, storm.kill, storm.stall, storm.reconnect, storm.command])()
            await storm.command()
            await storm.is_true()
        assert await storm.client.ask("run", RUN) == "ack"
        assert await storm.client.ask("disconnect") == "ack"
        assert it.session.state is State.IDLE
        assert fakes() == []
        await storm.client.close()
