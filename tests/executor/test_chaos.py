"""Random kills, stalls and disconnects: the ladder stays consistent, and no process is left."""

from __future__ import annotations

import asyncio
import contextlib
import os
import random
import signal
import sys
import time
from pathlib import Path

import psutil
import pytest

from executor.manager.manager import Manager, ManagerSettings
from executor.session.ladder import HAS_APPLICATION, State
from executor.supervision.shared_memory import FOLDER, mapped_files, remove_abandoned_segments
from tests.budget import count
from tests.executor.manager.test_server import FAKE, RUN, manager
from tests.executor.session_client import TOKEN, SessionClient, run_data

COMMANDS = ["run", "pause", "resume", "terminate_application", "disconnect", "reset_world"]
RECORDER = "executor.recorder.process"
PROGRAMS = {FAKE, "executor.world.process", "executor.application.process", RECORDER}


def supervised():
    """Returns the living children of a manager in this process."""
    return [p for p in psutil.Process().children() if _is_living(p)]


def _is_living(process):
    with contextlib.suppress(psutil.Error):  # it may end meanwhile
        return process.status() != psutil.STATUS_ZOMBIE and bool(PROGRAMS & set(process.cmdline()))
    return False


def segments_of(processes):
    """Returns the segments of shared memory that processes have mapped."""
    found = set()
    for process in processes:
        with contextlib.suppress(OSError):
            lines = Path(f"/proc/{process.pid}/maps").read_text().splitlines()
            found |= {line.rsplit("/", 1)[1] for line in lines if f"{FOLDER}/fastrtps_" in line}
    return {name.removesuffix(" (deleted)") for name in found}


class Storm:
    def __init__(self, it, chance, run=RUN):
        self.manager = it
        self.chance = chance
        self.run = run
        self.client = None
        self.segments = set()
        self.took_s = []

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
        await self.has_ended(victim.pid)
        if is_used and self.session.state.reaches(State.UNIVERSE_READY):
            # Viewers receive what died, and why.
            await self.client.event("fault", lambda d: "ended at once" in d["message"], after=at)

    @staticmethod
    async def has_ended(pid):
        """Waits for the end of a killed process, which takes a while on a busy machine."""
        async with asyncio.timeout(60):
            while pid in {process.pid for process in supervised()}:  # noqa: ASYNC110 - the process table
                await asyncio.sleep(0.02)

    async def stall(self):
        living = supervised()
        if living:
            victim = self.chance.choice(living)
            os.kill(victim.pid, signal.SIGSTOP)
            await asyncio.sleep(self.chance.random() * 0.2)  # the stall itself
            with contextlib.suppress(ProcessLookupError):  # the manager may have killed it meanwhile
                os.kill(victim.pid, signal.SIGCONT)

    async def reconnect(self):
        await self.client.close()
        await self.connect()

    async def command(self):
        name = self.chance.choice(COMMANDS)
        await self.client.ask(name, self.run if name == "run" else None, timeout_s=60)

    async def is_true(self):
        """Waits until the ladder agrees with the living processes."""
        began_s = time.monotonic()
        async with asyncio.timeout(60):
            while not self._is_consistent():  # noqa: ASYNC110 - it looks at the process table
                await asyncio.sleep(0.02)
        self.took_s.append(time.monotonic() - began_s)

    def _is_consistent(self):
        if self.session.state is State.IDLE or self.session.children.leaving:
            return not self.session.children.leaving
        started = {kind for kind, child in self.session.children.living.items() if child.is_started}
        needed = set()
        if self.session.state.reaches(State.UNIVERSE_READY):
            needed.add("world")
        if self.session.state in HAS_APPLICATION:
            needed.add("application")
        living = {process.pid for process in supervised()}
        pids = {key: child.pid for key, child in self.manager._supervisor._children.items()}
        if not set(pids.values()) <= living:
            return False  # one that waits to be used has died, and the manager has yet to hear of it
        children = self.session.children.living
        alive = {kind for kind in started if pids.get((kind, children[kind].number)) in living}
        return needed <= alive and len(living) <= len(children)

    async def blow(self, blows):
        """Disturbs and commands; after each of both the ladder must come true."""
        for _ in range(blows):
            await asyncio.sleep(self.chance.random() * 0.1)  # the moment of the disturbance is random
            await self.chance.choice([self.kill, self.kill, self.stall, self.reconnect, self.command])()
            await self.is_true()
            await self.command()
            await self.is_true()
            self.segments |= segments_of(supervised())
        assert await self.client.ask("run", self.run) == "ack"
        self.segments |= segments_of(supervised())
        assert await self.client.ask("disconnect") == "ack"
        assert self.session.state is State.IDLE
        # The recorder stays for clients that look back.
        assert all(RECORDER in process.cmdline() for process in supervised())
        await self.client.close()


def chance_of_today():
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    return random.Random(seed)  # noqa: S311


def tell(storm):
    took_s = sorted(storm.took_s)
    text = f"right again after {took_s[len(took_s) // 2]:.2f} s (median), {took_s[-1]:.2f} s (longest)"
    sys.stdout.write(f"{len(took_s)} times {text}\n")


async def test_the_session_survives_a_storm():
    chance = chance_of_today()
    async with manager() as it:
        storm = Storm(it, chance)
        await storm.connect()
        await storm.blow(count("manager_chaos"))
        tell(storm)


@pytest.mark.simulation
async def test_real_processes_survive_it_too_and_no_shared_memory_is_left():
    chance = chance_of_today()
    it = Manager(ManagerSettings(port=0, token=TOKEN))
    try:
        it.port = await it.start()  # type: ignore[attr-defined]
        storm = Storm(it, chance, run_data())
        await storm.connect()
        await storm.blow(count("manager_chaos_real"))
        tell(storm)
    finally:
        await it.close()
    assert supervised() == []
    assert storm.segments
    async with asyncio.timeout(60):
        # Young segments are kept for a while: their owner may not have locked them yet.
        while abandoned := abandoned_of(storm.segments):
            sys.stdout.write(f"still there: {sorted(abandoned)}\n")
            await asyncio.sleep(0.2)


def abandoned_of(names):
    """Returns the segments among these that exist after a clean-up and are mapped by no process."""
    remove_abandoned_segments()
    return {str(path) for path in FOLDER.iterdir() if path.name in names} - mapped_files()
