"""One child process with its descendants: spawns it, receives its messages, and ends its process tree."""

from __future__ import annotations

import asyncio
import contextlib
import os
import resource
import signal
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

import psutil

from executor.adapter_messages import FromAdapter, ToAdapter
from executor.child_messages import (
    FromExact,
    FromWorld,
    ToExact,
    ToWorld,
)
from executor.evaluation_messages import FromEvaluation, ToEvaluation
from executor.recorder_messages import FromRecorder, ToRecorder
from executor.supervision.channel import AsyncChannel, ChannelClosed, ChannelError, socket_pair
from executor.supervision.confine import INTERRUPT_SIGNAL, PARENT_VARIABLE
from executor.supervision.copies import MARK
from executor.supervision.handover import HANDOVER_VARIABLE, Arrival, handover_pair, receive
from executor.supervision.output import LineReader
from executor.supervision.pulse import NOTES_VARIABLE
from executor.supervision.signal_names import how_ended
from executor.supervision.signs import Notes, Signs, look_at

if TYPE_CHECKING:
    import socket
    from collections.abc import Iterable, Mapping

    from executor.supervision.adopted import AdoptedProcess

__all__ = ["ChildProcess", "Limits", "Program"]

Said = FromWorld | FromExact | FromRecorder | FromEvaluation | FromAdapter
Told = ToWorld | ToExact | ToRecorder | ToEvaluation | ToAdapter
Decode = Callable[[bytes], Said]

DRAIN_TIMEOUT_S: Final = 0.5
KILL_ROUNDS: Final = 200
CPU_GRACE_S: Final = 5
CLOSED_CHANNEL_GRACE_S: Final = 1.0


@dataclass(frozen=True)
class Limits:
    """Resource limits of a child; memory is limited for the process itself, and for its process tree."""

    memory_bytes: int | None = None
    file_bytes: int | None = None
    processes: int | None = None
    cpu_s: int | None = None


@dataclass(frozen=True)
class Program:
    """The command line of a kind of child; `--channel-fd N` is added if the child has a channel.

    With `makes_snapshots`, the child gets a socket over which it hands over copies of itself.
    """

    arguments: tuple[str, ...]
    environment: Mapping[str, str] = field(default_factory=dict)
    limits: Limits = field(default_factory=Limits)
    makes_snapshots: bool = False


class ChildProcess:
    """A running child.

    Args:
        program: the command line to run.
        on_message: is called with each message of the child, and with its output as `Log` messages.
        decode: converts bytes to a message; None for a program without a channel.

    Make it with `spawn`; `wait` returns once the process and all its descendants are gone.
    """

    def __init__(
        self,
        program: Program,
        popen: subprocess.Popen[bytes] | AdoptedProcess,
        mark: str,
        on_message: Callable[[Said], None],
        decode: Decode | None,
    ) -> None:
        self._decode = decode
        self.pid = popen.pid
        self._mark = mark
        self.reason = ""
        self.status: int | None = None
        """The exit status, for the log; negative for a signal."""
        self._program = program
        self._popen = popen
        self._on_message = on_message
        self._channel: AsyncChannel[Told, Said] | None = None
        self._notes: Notes | None = None
        self._signs: Signs | None = None
        self._link: socket.socket | None = None
        self.on_arrival: Callable[[Arrival], None] = Arrival.close
        """Called with each copy of the child that is handed over."""
        self.exited = asyncio.get_running_loop().create_future()
        self._is_reaped = False
        clock = asyncio.get_running_loop().time
        self._out = LineReader("info", on_message, clock)
        self._err = LineReader("warning", on_message, clock)
        self._readers: list[asyncio.Task[None]] = []

    @classmethod
    async def spawn(
        cls, program: Program, on_message: Callable[[Said], None], decode: Decode | None = None
    ) -> ChildProcess:
        """Starts a child. Call it from a thread that lives as long as the manager.

        Raises:
            OSError: the program cannot be started.
        """
        mark = os.urandom(8).hex()
        ours, notes, link = None, None, None
        with contextlib.ExitStack() as given, contextlib.ExitStack() as failed:
            fds: list[int] = []
            if decode is not None:
                ours, theirs = socket_pair()
                given.enter_context(theirs)
                failed.callback(ours.close)
                notes = Notes()
                failed.callback(notes.close)
                fds = [theirs.fileno(), notes.fd]
            if program.makes_snapshots:
                link, their_link = handover_pair()
                given.enter_context(their_link)
                failed.callback(link.close)
                fds.append(their_link.fileno())
            popen = cls._start(program, mark, *fds)
            failed.pop_all()
        child = cls(program, popen, mark, on_message, decode)
        child._notes, child._link = notes, link
        child._limit()
        await child._listen(ours)
        return child

    @classmethod
    async def adopt(
        cls,
        program: Program,
        process: AdoptedProcess,
        on_message: Callable[[Said], None],
        decode: Decode,
    ) -> ChildProcess:
        """Takes over a copy of a child that was handed over."""
        child = cls(program, process, process.mark, on_message, decode)
        child._notes, child._link = Notes(process.notes_fd), process.link
        await child._listen(process.channel)
        return child

    @staticmethod
    def _start(
        program: Program,
        mark: str,
        channel_fd: int | None = None,
        notes_fd: int | None = None,
        link_fd: int | None = None,
    ) -> subprocess.Popen[bytes]:
        own = {PARENT_VARIABLE: str(os.getpid()), MARK: mark, "PYTHONUNBUFFERED": "1"}
        if notes_fd is not None:
            own[NOTES_VARIABLE] = str(notes_fd)
        if link_fd is not None:
            own[HANDOVER_VARIABLE] = str(link_fd)
        return subprocess.Popen(
            [*program.arguments, *([] if channel_fd is None else ["--channel-fd", str(channel_fd)])],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            pass_fds=[fd for fd in (channel_fd, notes_fd, link_fd) if fd is not None],
            start_new_session=True,
            env={**os.environ, **program.environment, **own},
        )

    @property
    def last_lines(self) -> tuple[str, ...]:
        """The last lines of its error output."""
        return tuple(self._err.last_lines)

    def tell(self, message: Told) -> None:
        """Sends a message to the child.

        It is lost if the child has ended; a child that does not read is killed.
        """
        if self._channel is None:
            return
        try:
            self._channel.send(message)
        except ChannelClosed as error:
            self.kill(f"was ended: {error}")

    def look(self) -> tuple[str, float, float] | None:
        """Samples the child: its state, and how long it ran and waited for a processor since the last sample.

        Returns None for the first sample, for a child that has ended, and for a child without a channel.
        """
        if self._channel is None or self.exited.done():
            return None
        before, self._signs = self._signs, look_at(self.pid)
        if self._signs is None or before is None:
            return None
        return self._signs.state, self._signs.ran_s - before.ran_s, self._signs.waited_s - before.waited_s

    async def trace(self) -> tuple[str, int]:
        """Returns a dump of the child's stacks, and the number of the tree node that is being ticked.

        Without a dump they are "" and 0.
        """
        if self._notes is None or self.exited.done():
            return "", 0
        text = await self._notes.trace(self.pid)
        return text, self._notes.current_uid() if not self.exited.done() else 0

    def interrupt(self) -> None:
        """Interrupts the child's current tick."""
        if not self.exited.done():
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, INTERRUPT_SIGNAL)

    def ask_to_end(self) -> None:
        """Interrupts a child without a channel, as Ctrl+C would; other children were asked by a message."""
        if self._decode is None and not self._is_reaped:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self.pid, signal.SIGINT)

    def kill(self, reason: str = "") -> None:
        """Kills the child's process group; `wait` ends the rest of its descendants."""
        self.reason = self.reason or reason
        if self._is_reaped:
            return  # its number may be that of another process
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.pid, signal.SIGKILL)

    async def wait(self) -> None:
        """Waits until no process of the child is left; `reason` then tells how it ended."""
        await self.exited
        self.kill()
        self._is_reaped = True
        self.status = code = self._popen.wait()
        self.reason = self.reason or _exit_reason(code, self._program.limits)
        await asyncio.wait(self._readers, timeout=DRAIN_TIMEOUT_S)
        await self._end_tree()
        await asyncio.wait(self._readers, timeout=DRAIN_TIMEOUT_S)
        for reader in self._readers:
            reader.cancel()
        await asyncio.gather(*self._readers, return_exceptions=True)
        if self._channel is not None:
            self._channel.close()
        if self._notes is not None:
            self._notes.close()
        self._close_link()

    def check_limits(self, descendants: Iterable[psutil.Process]) -> None:
        """Kills the child if its processes, which are searched in `descendants`, exceed its limits."""
        limits = self._program.limits
        if limits.processes is None and limits.memory_bytes is None:
            return  # a tree is read from /proc, four times in a second
        tree = self._tree(descendants)
        if limits.processes is not None and len(tree) > limits.processes:
            self.kill(f"was ended: it had {len(tree)} processes, more than the {limits.processes} allowed")
        elif (allowed := limits.memory_bytes) is not None and (used := _used_bytes(tree, allowed)) > allowed:
            self.kill(
                f"was ended: it used {used >> 20} MB of memory, more than the {allowed >> 20} MB allowed"
            )

    def tree(self) -> list[psutil.Process]:
        """Returns the child's process and its living descendants, also those that left its process group."""
        return self._tree(psutil.Process().children(recursive=True))

    def _tree(self, descendants: Iterable[psutil.Process]) -> list[psutil.Process]:
        family = {self.pid}
        found = []
        # Parents come before their children, so one pass finds whole branches.
        for process in descendants:
            with contextlib.suppress(psutil.Error, OSError), process.oneshot():
                if process.status() == psutil.STATUS_ZOMBIE:
                    continue
                if process.pid in family or process.ppid() in family or self._is_marked(process):
                    family.add(process.pid)
                    found.append(process)
        return found

    def _is_marked(self, process: psutil.Process) -> bool:
        return os.getsid(process.pid) == self.pid or process.environ().get(MARK) == self._mark

    def _limit(self) -> None:
        limits = self._program.limits
        wanted = {
            resource.RLIMIT_DATA: limits.memory_bytes,
            resource.RLIMIT_FSIZE: limits.file_bytes,
            resource.RLIMIT_CORE: 0,
        }
        for which, value in wanted.items():
            if value is not None:
                with contextlib.suppress(ProcessLookupError, PermissionError, ValueError):
                    resource.prlimit(self.pid, which, (value, value))
        if limits.cpu_s is not None:
            with contextlib.suppress(ProcessLookupError, PermissionError, ValueError):
                # The signal of the soft limit identifies the cause; the hard limit would send SIGKILL.
                resource.prlimit(self.pid, resource.RLIMIT_CPU, (limits.cpu_s, limits.cpu_s + CPU_GRACE_S))

    async def _listen(self, ours: socket.socket | None) -> None:
        loop = asyncio.get_running_loop()
        pidfd = os.pidfd_open(self.pid)
        loop.add_reader(pidfd, self._on_exit, pidfd)
        for pipe, reader in ((self._popen.stdout, self._out), (self._popen.stderr, self._err)):
            stream = asyncio.StreamReader()
            await loop.connect_read_pipe(lambda s=stream: asyncio.StreamReaderProtocol(s), pipe)  # type: ignore[misc]
            self._readers.append(loop.create_task(reader.read(stream)))
        if ours is not None and self._decode is not None:
            self._channel = await AsyncChannel.open(ours, self._decode)
            self._readers.append(loop.create_task(self._read_channel(self._channel)))
        if self._link is not None:
            loop.add_reader(self._link.fileno(), self._take_arrivals, self._link)

    def _take_arrivals(self, link: socket.socket) -> None:
        try:
            while True:
                if (arrival := receive(link)) is not None:
                    self.on_arrival(arrival)
        except BlockingIOError:
            pass
        except (EOFError, OSError):
            self._close_link()

    def _close_link(self) -> None:
        if self._link is not None:
            asyncio.get_running_loop().remove_reader(self._link.fileno())
            self._link.close()
            self._link = None

    async def _read_channel(self, channel: AsyncChannel[Told, Said]) -> None:
        try:
            while True:
                self._on_message(await channel.receive())
        except ChannelClosed:
            # Usually the child is ending. Without its channel it could not receive `Stop`.
            await asyncio.wait([self.exited], timeout=CLOSED_CHANNEL_GRACE_S)
            self.kill("was ended: it closed its channel" if not self.exited.done() else "")
        except ChannelError as error:
            self.kill(f"was ended: it broke its channel ({error})")

    def _on_exit(self, pidfd: int) -> None:
        asyncio.get_running_loop().remove_reader(pidfd)
        os.close(pidfd)
        self.exited.set_result(None)

    async def _end_tree(self) -> None:
        killed: set[int] = set()
        for round_ in range(KILL_ROUNDS):
            left = self.tree()
            self._reap(killed)
            if not left:
                return
            for process in left:
                with contextlib.suppress(psutil.Error):
                    process.kill()
                    killed.add(process.pid)
            await asyncio.sleep(0.005 if round_ < 20 else 0.05)

    def _reap(self, killed: set[int]) -> None:
        """Collects the exit status of orphans of the child that have ended."""
        for process in psutil.Process().children():
            with contextlib.suppress(psutil.Error, OSError):
                is_ours = process.pid in killed or os.getsid(process.pid) == self.pid
                if is_ours and process.status() == psutil.STATUS_ZOMBIE:
                    os.waitpid(process.pid, os.WNOHANG)


def _exit_reason(code: int, limits: Limits) -> str:
    if code == -signal.SIGXCPU:
        return f"was ended: it used more than the {limits.cpu_s} s of CPU time allowed"
    if code == -signal.SIGXFSZ and limits.file_bytes is not None:
        return f"was ended: it wrote a file of more than the {limits.file_bytes >> 20} MB allowed"
    return how_ended(code)


def _used_bytes(tree: Iterable[psutil.Process], limit: int) -> int:
    """Returns the memory of a process tree in bytes.

    Makes the slow exact count only if the rough one is near the limit.
    """
    tree = list(tree)
    rough = _sum_up(tree, lambda process: process.memory_info().rss)
    return rough if rough <= limit else _sum_up(tree, lambda process: process.memory_full_info().pss)


def _sum_up(tree: Iterable[psutil.Process], measure: Callable[[psutil.Process], int]) -> int:
    total = 0
    for process in tree:
        with contextlib.suppress(psutil.Error):
            total += measure(process)
    return total
