"""Starts, supervises and ends the children of a session, as its state machine requires."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import sys
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import psutil

from executor import child_messages
from executor.adapter_messages import decode_from_adapter
from executor.child_messages import Frame, decode_from_application, decode_from_exact, decode_from_world
from executor.evaluation_messages import decode_from_evaluation
from executor.recorder_messages import decode_from_recorder
from executor.session.events import (
    ChildExited,
    ChildLooked,
    ChildSaid,
    ChildTraced,
    DropSnapshot,
    Effect,
    Event,
    Inspect,
    Interrupt,
    Kill,
    Kind,
    Retire,
    Spawn,
    Tell,
    WakeSnapshot,
)
from executor.supervision.confine import adopt_orphans
from executor.supervision.descendants import Descendants
from executor.supervision.processes import ChildProcess, Decode, Program, Said
from executor.supervision.shared_memory import remove_abandoned_segments
from executor.supervision.snapshots import SnapshotProcesses

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterator, Mapping

__all__ = ["Supervisor"]

_log = logging.getLogger(__name__)

CHECK_INTERVAL_S: Final = 0.25
_DECODE: Final[dict[Kind, Decode]] = {
    "world": decode_from_world,
    "application": decode_from_application,
    "exact": decode_from_exact,
    "recorder": decode_from_recorder,
    "evaluation": decode_from_evaluation,
    "adapter": decode_from_adapter,
}


class Supervisor:
    """The children of one session.

    Args:
        programs: the program of each kind of child.
        report: is called with each `ChildSaid`, `ChildLooked`, `ChildTraced` and `ChildExited`, on the event
            loop.
        on_frame: is called with each frame; frames bypass the state machine.
        reaps_all: whether every other child process of this process is an orphan of one of the session's
            children, except within `starting_others`.
    """

    def __init__(
        self,
        programs: Mapping[Kind, Program],
        report: Callable[[Event], None],
        on_frame: Callable[[Frame], None],
        *,
        reaps_all: bool = False,
    ) -> None:
        self._reaps_all = reaps_all
        self._programs = programs
        self._report = report
        self._on_frame = on_frame
        self._children: dict[tuple[Kind, int], ChildProcess] = {}
        self._waiting: dict[tuple[Kind, int], list[Effect]] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._checker: asyncio.Task[None] | None = None
        self._descendants = Descendants()
        self._snapshots = SnapshotProcesses(report)
        self._others = 0
        adopt_orphans()

    def apply(
        self, effect: Spawn | Tell | Interrupt | Inspect | Retire | Kill | WakeSnapshot | DropSnapshot
    ) -> None:
        """Carries out an effect; results are reported as events."""
        if isinstance(effect, DropSnapshot):
            self._snapshots.drop((effect.child, effect.snapshot))
            return
        key = (effect.kind, effect.number)
        if isinstance(effect, Spawn | WakeSnapshot):
            self._waiting[key] = []
            self._do(self._live(effect))
        elif key in self._waiting:
            self._waiting[key].append(effect)  # applied when the start of the child has finished
        elif (child := self._children.get(key)) is not None:
            self._apply_to(child, effect)
        elif isinstance(effect, Inspect):
            self._report(ChildTraced(effect.kind, effect.number))

    async def end(self, kind: Kind, grace_s: float) -> None:
        """Asks the children of a kind to end, and waits for that at most for a time in s."""
        children = [child for (of_kind, _), child in self._children.items() if of_kind == kind]
        for child in children:
            child.tell(child_messages.Stop())
        if children:
            await asyncio.wait([child.exited for child in children], timeout=grace_s)

    @contextlib.contextmanager
    def starting_others(self) -> Iterator[None]:
        """Leaves the status of ended processes to who started them, while this process runs one itself."""
        self._others += 1
        try:
            yield
        finally:
            self._others -= 1

    async def close(self) -> None:
        """Kills all children, and waits until none of their processes is left."""
        if self._checker is not None:
            self._checker.cancel()
        await self._snapshots.close()
        while self._tasks:
            for child in self._children.values():
                child.kill()
            await asyncio.wait(self._tasks, timeout=0.1)

    @property
    def pids(self) -> list[int]:
        """The process ids of the children, and of their snapshots."""
        return [child.pid for child in self._children.values()] + self._snapshots.pids

    def _apply_to(self, child: ChildProcess, effect: Effect) -> None:
        match effect:
            case Tell():
                child.tell(effect.message)
            case Interrupt():
                child.interrupt()
            case Inspect():
                self._do(self._trace(child, effect))
            case Retire():
                self._do(self._retire(child, effect.grace_s))
            case Kill():
                child.kill("was ended")
            case _:
                raise TypeError(effect)

    def _do(self, coroutine: Coroutine[Any, Any, None]) -> None:
        task = asyncio.get_running_loop().create_task(coroutine)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _live(self, spawn: Spawn | WakeSnapshot) -> None:
        """Runs a child from its start to its exit, and reports its events."""
        key = (spawn.kind, spawn.number)

        def on_message(message: Said) -> None:
            if isinstance(message, Frame):
                self._on_frame(message)
            else:
                self._report(ChildSaid(spawn.kind, spawn.number, message))

        try:
            child = await self._begin(spawn, on_message)
        except OSError as error:
            self._waiting.pop(key)
            self._report(ChildExited(spawn.kind, spawn.number, f"could not be started: {error}"))
            return
        self._children[key] = child
        child.on_arrival = partial(self._snapshots.arrived, spawn.number)
        if self._checker is None:
            self._checker = asyncio.get_running_loop().create_task(self._check_limits())
        for effect in self._waiting.pop(key):
            self._apply_to(child, effect)
        await child.wait()
        del self._children[key]
        await asyncio.to_thread(remove_abandoned_segments)
        _log.info("%s %d %s (status %s)", spawn.kind, child.pid, child.reason, child.status)
        self._report(ChildExited(spawn.kind, spawn.number, child.reason, child.last_lines))

    async def _begin(self, spawn: Spawn | WakeSnapshot, on_message: Callable[[Said], None]) -> ChildProcess:
        if isinstance(spawn, Spawn):
            return await ChildProcess.spawn(self._program(spawn), on_message, _DECODE.get(_program_of(spawn)))
        process = await self._snapshots.wake((spawn.child, spawn.snapshot))
        return await ChildProcess.adopt(self._programs["exact"], process, on_message, decode_from_exact)

    def _program(self, spawn: Spawn) -> Program:
        if spawn.node is None:
            return self._programs[_program_of(spawn)]
        # A launch node has the limits of the application.
        application = self._programs["application"]
        command = (sys.executable, "-m", "executor.launching.program", spawn.folder, *spawn.node.command)
        environment = {**application.environment, **dict(spawn.node.environment)}
        return Program(command, environment, application.limits)

    async def _trace(self, child: ChildProcess, effect: Inspect) -> None:
        text, uid = await child.trace()
        self._report(ChildTraced(effect.kind, effect.number, text, uid))

    async def _retire(self, child: ChildProcess, grace_s: float) -> None:
        child.ask_to_end()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(asyncio.shield(child.exited), grace_s)
        child.kill("was ended")

    async def _check_limits(self) -> None:
        while True:
            await asyncio.sleep(CHECK_INTERVAL_S)
            for (kind, number), child in list(self._children.items()):
                if (signs := child.look()) is not None:
                    self._report(ChildLooked(kind, number, *signs))
            await self._snapshots.weigh()
            there = self._descendants.look()
            self._snapshots.reap(there)
            waiting = set(self._snapshots.pids)  # they count to no limit
            limited = [process for process in there if process.pid not in waiting]
            for (kind, _), child in list(self._children.items()):
                if kind != "world":
                    child.check_limits(limited)
            if self._reaps_all and not self._others:
                self._reap_orphans(there)

    def _reap_orphans(self, descendants: list[psutil.Process]) -> None:
        pids, own = self.pids, os.getpid()
        for process in descendants:
            with contextlib.suppress(psutil.Error, OSError), process.oneshot():
                if (
                    process.pid not in pids
                    and process.ppid() == own
                    and process.status() == psutil.STATUS_ZOMBIE
                ):
                    os.waitpid(process.pid, os.WNOHANG)


def _program_of(spawn: Spawn) -> Kind:
    return "exact" if spawn.is_exact else spawn.kind
