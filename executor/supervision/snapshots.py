"""The snapshots of a session: processes that wait, which owe no signs of life and count to no limit.

The manager holds an end of a socket of each; a snapshot ends when that is closed.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import socket
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import psutil

from executor.session.events import SnapshotEnded, SnapshotWeighed
from executor.supervision.adopted import AdoptedProcess
from executor.supervision.copies import SNAPSHOT_NAME
from executor.supervision.handover import receive, sees_senders
from executor.supervision.room import memory_room, private_bytes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from executor.session.events import Event
    from executor.supervision.handover import Arrival

__all__ = ["SnapshotProcesses"]

MOST: Final = 64
WAKE_S: Final = 5.0
ARRIVAL_S: Final = 2.0
WEIGH_S: Final = 30.0
"""How old the memory of a snapshot may be: the kernel walks its page tables, some ms of a processor."""
GROWING_WEIGH_S: Final = 5.0
"""The same for the one from which the run continues: what that writes now is left to the snapshot."""
MOST_WEIGHED: Final = 3
"""So many are read at most in one turn: a run that is as fast as possible makes some in each second."""
Key = tuple[int, int]


@dataclass
class _Snapshot:
    pid: int
    pidfd: int
    end: socket.socket
    made_s: float
    parent: Key | None
    """The snapshot before it on the way of the run that made it, if that is there."""
    weighed_s: float = -1.0
    size_bytes: int = 0
    has_changed: bool = False
    """Whether pages that it shared may have become its own since its memory was read."""


class SnapshotProcesses:
    """The processes; each has as its key the number of the child that made it, and its own number.

    Args:
        report: is called with each `SnapshotEnded` and `SnapshotWeighed`, on the event loop.
    """

    def __init__(self, report: Callable[[Event], None]) -> None:
        self._report = report
        self._there: dict[Key, _Snapshot] = {}
        self._dropped: set[Key] = set()
        self._gone: set[Key] = set()
        self._growing: Key | None = None

    @property
    def pids(self) -> list[int]:
        """The process ids."""
        return [snapshot.pid for snapshot in self._there.values()]

    def arrived(self, child: int, arrival: Arrival) -> None:
        """Takes a snapshot that a child has made."""
        key = (child, arrival.number)
        if key in self._there or key in self._dropped or len(arrival.fds) != 1 or len(self._there) >= MOST:
            self._dropped.discard(key)
            arrival.close()  # without this end it ends
            return
        (fd,), arrival.fds = arrival.fds, []
        try:
            end = socket.socket(fileno=fd)
        except OSError:
            os.close(fd)
            return
        try:
            sees_senders(end)
            pidfd = os.pidfd_open(arrival.pid)
        except OSError:
            end.close()
            return
        loop = asyncio.get_running_loop()
        self._there[key] = _Snapshot(arrival.pid, pidfd, end, loop.time(), self._growing)
        self._run_continues_from(key)
        loop.add_reader(pidfd, self._ended, key)

    def drop(self, key: Key) -> None:
        """Ends a snapshot, also one that has not arrived yet."""
        snapshot = self._there.get(key)
        if snapshot is None:
            self._dropped.add(key)
            return
        with contextlib.suppress(OSError):
            signal.pidfd_send_signal(snapshot.pidfd, signal.SIGKILL)

    async def wake(self, key: Key) -> AdoptedProcess:
        """Makes a snapshot fork a copy, and returns that.

        Raises:
            OSError: the snapshot has ended, or does not answer.
        """
        loop = asyncio.get_running_loop()
        until_s = loop.time() + ARRIVAL_S
        while (snapshot := self._there.get(key)) is None:
            if key in self._gone or loop.time() > until_s:
                raise OSError("the snapshot has ended")
            await asyncio.sleep(0.01)  # it was announced, and is on its way
        readable = asyncio.Event()
        loop.add_reader(snapshot.end.fileno(), readable.set)
        try:
            snapshot.end.send(str(os.getpid()).encode())
            await asyncio.wait_for(readable.wait(), WAKE_S)
        except TimeoutError:
            raise OSError("the snapshot does not answer") from None
        finally:
            loop.remove_reader(snapshot.end.fileno())
        try:
            arrival = receive(snapshot.end)
        except EOFError:
            arrival = None
        if arrival is None:
            raise OSError("the snapshot has ended")
        try:
            process = AdoptedProcess(arrival)
        except ValueError as error:
            raise OSError(f"the snapshot answers wrongly: {error}") from error
        self._run_continues_from(key)
        return process

    async def weigh(self) -> None:
        """Reads the memory of the snapshots whose turn it is, if it is one's; reports what room is left."""
        now_s = asyncio.get_running_loop().time()
        room = memory_room()
        due = self._due(now_s)[:MOST_WEIGHED]
        if not due:
            if room is not None and self._there:  # it can become short within a moment
                key, snapshot = next(iter(self._there.items()))
                self._report(SnapshotWeighed(*key, snapshot.size_bytes, room))
            return
        for key in due:
            if (there := self._there.get(key)) is None:  # it ended while another one was read
                continue
            there.weighed_s, there.has_changed = now_s, False
            there.size_bytes = await asyncio.to_thread(private_bytes, there.pid)
            if key in self._there:
                self._report(SnapshotWeighed(*key, there.size_bytes, room))

    def reap(self, descendants: Iterable[psutil.Process]) -> None:
        """Takes the status of snapshots that ended before they arrived."""
        own, known = os.getpid(), set(self.pids)
        for process in descendants:
            if process.pid in known:
                continue
            with contextlib.suppress(psutil.Error, OSError), process.oneshot():
                if (
                    process.status() == psutil.STATUS_ZOMBIE
                    and process.name() == SNAPSHOT_NAME
                    and process.ppid() == own
                ):
                    os.waitpid(process.pid, os.WNOHANG)

    async def close(self) -> None:
        """Ends all, and waits until none is left."""
        while self._there:
            for key in list(self._there):
                self.drop(key)
            await asyncio.sleep(0.005)

    def _run_continues_from(self, key: Key | None) -> None:
        if self._growing in self._there:
            self._there[self._growing].has_changed = True  # for the last time
        self._growing = key

    def _due(self, now_s: float) -> list[Key]:
        """Returns the snapshots whose memory may have changed; those that were read the longest ago first."""

        def is_due(key: Key) -> bool:
            snapshot = self._there[key]
            oldest_s = GROWING_WEIGH_S if key == self._growing else WEIGH_S
            return snapshot.has_changed or max(snapshot.made_s, snapshot.weighed_s) <= now_s - oldest_s

        return sorted(filter(is_due, self._there), key=lambda key: self._there[key].weighed_s)

    def _ended(self, key: Key) -> None:
        snapshot = self._there.pop(key)
        # Only snapshots that follow each other share a page: what one of them has left is its neighbour's.
        for other, each in self._there.items():
            if each.parent == key:
                each.parent, each.has_changed = snapshot.parent, True
            elif other == snapshot.parent:
                each.has_changed = True
        if key == self._growing:
            self._growing = snapshot.parent
        self._gone.add(key)
        loop = asyncio.get_running_loop()
        loop.remove_reader(snapshot.pidfd)
        with contextlib.suppress(OSError):
            os.waitpid(snapshot.pid, os.WNOHANG)
        os.close(snapshot.pidfd)
        snapshot.end.close()
        self._report(SnapshotEnded(*key))
