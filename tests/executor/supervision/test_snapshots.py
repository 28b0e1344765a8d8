"""Snapshots in the manager's eyes: they end when they are dropped, and what they answer is not believed."""

from __future__ import annotations

import asyncio
import math
import os
import subprocess
import sys
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from executor.session.events import SnapshotEnded, SnapshotWeighed
from executor.supervision import snapshots
from executor.supervision.handover import handover_pair, receive
from executor.supervision.snapshots import MOST, SnapshotProcesses

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

ROOT = Path(__file__).parents[3]
WAITS = """
import os, socket, sys, time
from executor.supervision.handover import handover_pair, send
link = socket.socket(fileno=int(sys.argv[1]))
theirs, ours = handover_pair()
send(link, int(sys.argv[2]), "0" * 16, [theirs.fileno()])
theirs.close(); link.close()
ours.setblocking(True)
while order := ours.recv(32):
    {answer}
"""


class Waiting:
    """Snapshots, and the events about them."""

    def __init__(self) -> None:
        self.events: list[Any] = []
        self.changed = asyncio.Event()
        self.there = SnapshotProcesses(self.report)
        self.processes: list[subprocess.Popen[bytes]] = []

    def report(self, event: Any) -> None:
        self.events.append(event)
        self.changed.set()

    def _spawn(self, fd: int, number: int, answer: str) -> None:
        command = [sys.executable, "-c", WAITS.replace("{answer}", answer), str(fd), str(number)]
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        self.processes.append(subprocess.Popen(command, pass_fds=[fd], env=environment))

    async def start(self, number: int, answer: str = "pass") -> None:
        ours, theirs = handover_pair()
        with theirs:
            self._spawn(theirs.fileno(), number, answer)
        ours.setblocking(True)
        arrival = await asyncio.to_thread(receive, ours)
        ours.close()
        assert arrival is not None
        assert arrival.pid == self.processes[-1].pid
        self.there.arrived(1, arrival)

    async def until(self, event: Any) -> None:
        async with asyncio.timeout(30):
            while event not in self.events:
                self.changed.clear()
                await self.changed.wait()


@asynccontextmanager
async def waiting() -> AsyncIterator[Waiting]:
    it = Waiting()
    yield it
    await it.there.close()
    assert it.there.pids == []
    for process in it.processes:
        process.wait(30)


async def test_a_dropped_snapshot_ends_also_before_it_arrives() -> None:
    async with waiting() as it:
        await it.start(1)
        it.there.drop((1, 1))
        await it.until(SnapshotEnded(1, 1))
        it.there.drop((1, 2))
        await it.start(2)
        assert it.there.pids == []
        await asyncio.to_thread(it.processes[-1].wait, 30)


async def test_a_snapshot_that_dies_is_reported() -> None:
    async with waiting() as it:
        await it.start(1)
        it.processes[0].kill()
        await it.until(SnapshotEnded(1, 1))
        with pytest.raises(OSError, match="has ended"):
            await it.there.wake((1, 1))


@pytest.mark.parametrize(
    "answer", ["ours.send(b'nonsense')", "socket.send_fds(ours, [b'0 ' + b'0' * 16], [0, 1])", "break"]
)
async def test_a_wrong_answer_is_a_failure(answer: str) -> None:
    async with waiting() as it:
        await it.start(1, answer)
        with pytest.raises(OSError, match="snapshot"):
            await it.there.wake((1, 1))


async def weighed(it: Waiting) -> list[int]:
    """Returns the snapshots whose memory is due to be read now, in that order."""
    it.events.clear()
    for _ in range(5):
        await it.there.weigh()
    found = [event for event in it.events if isinstance(event, SnapshotWeighed)]
    assert all(event.size_bytes > 0 for event in found)
    return [event.snapshot for event in found]


async def test_memory_is_read_where_pages_may_have_become_a_snapshots_own(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("WEIGH_S", "GROWING_WEIGH_S"):  # a busy machine takes longer
        monkeypatch.setattr(snapshots, name, math.inf)
    async with waiting() as it:
        assert await weighed(it) == []
        await it.start(1)
        assert await weighed(it) == []
        await it.start(2)
        assert await weighed(it) == [1], "the run writes into pages of the second now"
        await it.start(3)
        await it.start(4)
        await it.start(5)
        assert await weighed(it) == [2, 3, 4]
        it.there.drop((1, 2))
        await it.until(SnapshotEnded(1, 2))
        assert await weighed(it) == [1, 3], "they follow it, or it follows them"
        it.there.drop((1, 5))
        await it.until(SnapshotEnded(1, 5))
        assert await weighed(it) == [4]
        await it.start(6)
        assert await weighed(it) == [4], "the run wrote into its pages after the fifth had ended"


async def test_memory_of_two_ways_is_read_where_they_part(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("WEIGH_S", "GROWING_WEIGH_S"):
        monkeypatch.setattr(snapshots, name, math.inf)
    async with waiting() as it:
        for number in (1, 2, 3):
            await it.start(number)
        it.there._run_continues_from((1, 1))  # it was woken
        await it.start(4)
        assert await weighed(it) == [1, 2, 3]
        it.there.drop((1, 4))
        await it.until(SnapshotEnded(1, 4))
        assert await weighed(it) == [1], "the third is on another way"


async def test_memory_is_read_again_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(snapshots, "WEIGH_S", math.inf)
    monkeypatch.setattr(snapshots, "GROWING_WEIGH_S", math.inf)
    async with waiting() as it:
        await it.start(1)
        await it.start(2)
        assert await weighed(it) == [1]
        monkeypatch.setattr(snapshots, "GROWING_WEIGH_S", 0.0)
        assert set(await weighed(it)) == {2}
        monkeypatch.setattr(snapshots, "WEIGH_S", 0.0)
        assert set(await weighed(it)) == {1, 2}


async def test_the_same_number_and_too_many_are_not_taken() -> None:
    async with waiting() as it:
        await it.start(1)
        await it.start(1)
        assert len(it.there.pids) == 1
        assert MOST >= 40 + 4
