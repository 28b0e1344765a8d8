"""Snapshots of exact runs with real processes: they continue as the run would have, to the last bit."""

from __future__ import annotations

import asyncio
import os
import random
import signal
import tempfile
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import psutil
import pytest

from executor import child_messages
from executor.child_messages import ForWorld
from executor.exact import snapshots
from executor.manager.archive import unpack
from executor.manager.programs import session_programs
from executor.replay_messages import FINGERPRINT_BYTES, Replay
from executor.session.events import (
    ChildExited,
    ChildSaid,
    Spawn,
    Tell,
    WakeSnapshot,
)
from executor.supervision.copies import SNAPSHOT_NAME
from executor.supervision.handover import handover_pair
from executor.supervision.parking import Parking
from executor.supervision.supervisor import Supervisor
from tests.executor.exact.exact_runs import app_folder, hashing_app, start_message
from tests.executor.exact.random_projects import random_project
from tests.executor.exact.test_process import exact, ready
from tests.executor.session_client import SessionClient, manager_process
from tests.processes import with_word

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable

    from executor.replay_messages import Input

pytestmark = pytest.mark.simulation

FIRST = 1
# The seed of a random project with a camera.
WITH_CAMERA = 1


class Runs:
    """Exact runs below a supervisor, and what they said, by the number of the child."""

    def __init__(self) -> None:
        self.said: dict[int, list[Any]] = {}
        self.events: list[Any] = []
        self.changed = asyncio.Event()
        programs = session_programs(3)
        self.supervisor = Supervisor(
            {"exact": programs["exact"], "application": programs["exact"]}, self.report, lambda _: None
        )

    def report(self, event: Any) -> None:
        self.events.append(event)
        if isinstance(event, ChildSaid):
            self.said.setdefault(event.number, []).append(event.message)
        self.changed.set()

    def tell(self, number: int, message: Any) -> None:
        self.supervisor.apply(Tell("application", number, message))

    def of(self, number: int, kind: type[Any]) -> list[Any]:
        return [message for message in self.said.get(number, []) if isinstance(message, kind)]

    def prints(self, number: int) -> bytes:
        return b"".join(message.data for message in self.of(number, child_messages.Fingerprints))

    def inputs(self, number: int) -> list[Input]:
        return [message.input for message in self.of(number, child_messages.Entered)]

    async def until(self, condition: Callable[[], Any]) -> Any:
        async with asyncio.timeout(60):
            while not (value := condition()):
                self.changed.clear()
                await self.changed.wait()
                faults = [
                    m for said in self.said.values() for m in said if isinstance(m, child_messages.Fault)
                ]
                assert faults == []
        return value

    async def begin(self, folder: Path, **more: Any) -> None:
        self.supervisor.apply(Spawn("application", FIRST, is_exact=True))
        self.tell(FIRST, start_message(folder, **more))
        await self.until(lambda: self.of(FIRST, child_messages.ApplicationReady))
        self.tell(FIRST, child_messages.KeepSnapshots(is_on=True))
        self.resume(FIRST)

    def resume(self, number: int) -> None:
        self.tell(number, child_messages.Resume())
        self.tell(number, ForWorld(child_messages.Resume()))

    async def pause(self, number: int) -> None:
        self.tell(number, child_messages.Pause())
        self.tell(number, ForWorld(child_messages.Pause()))
        self.tell(number, child_messages.StepTick())
        await self.until(lambda: self.of(number, child_messages.Stepped))
        self.tell(number, child_messages.Pause())
        await self.until(lambda: len(self.of(number, child_messages.Paused)) >= 2)

    async def ticks(self, number: int, count: int) -> None:
        await self.until(lambda: any(m.n >= count for m in self.of(number, child_messages.Tick)))

    async def end(self, number: int) -> bytes:
        self.tell(number, child_messages.Stop())
        await self.until(lambda: self.exited(number))
        (state,) = self.of(number, child_messages.WorldState)
        return bytes(state.data)

    def exited(self, number: int) -> bool:
        return any(isinstance(e, ChildExited) and e.number == number for e in self.events)

    def wake(self, snapshot: int, number: int, until_s: float | None, *, child: int = FIRST) -> None:
        replay = Replay(self.inputs(FIRST), self.prints(FIRST), until_s)
        self.supervisor.apply(WakeSnapshot(child, snapshot, number))
        self.tell(number, child_messages.Awake(replay, 0.0))

    async def back(self, number: int) -> Any:
        done = (child_messages.ApplicationReady, child_messages.Fault)
        await self.until(lambda: self.exited(number) or any(self.of(number, kind) for kind in done))
        assert self.of(number, child_messages.Fault) == []
        (there,) = self.of(number, child_messages.WentBack)
        return there


@asynccontextmanager
async def runs() -> AsyncIterator[Runs]:
    it = Runs()
    try:
        yield it
    finally:
        await it.supervisor.close()
        assert with_word("executor.exact", psutil.Process().children(recursive=True)) == []


def test_no_process_is_forked_while_another_thread_of_ours_works(monkeypatch: pytest.MonkeyPatch) -> None:
    parking = Parking()
    monkeypatch.setattr(snapshots, "PARKING", parking)
    monkeypatch.setattr(snapshots, "fork_away", lambda: pytest.fail("it was forked"))
    ours, theirs = handover_pair()
    with ours, theirs, parking.spot():
        assert snapshots.Snapshots(theirs).take(1) is False


async def test_copies_of_snapshots_end_where_the_run_ended() -> None:
    with app_folder() as folder:
        async with runs() as it:
            await it.begin(folder)
            await it.ticks(FIRST, 30)
            it.tell(FIRST, ForWorld(child_messages.Teleop(0.2, 0.7)))
            await it.ticks(FIRST, 60)
            it.tell(FIRST, child_messages.SetBlackboard("", "nudge", 4))
            await it.ticks(FIRST, 200)
            await it.until(lambda: len(it.of(FIRST, child_messages.SnapshotTaken)) >= 2)
            await it.pause(FIRST)
            taken = it.of(FIRST, child_messages.SnapshotTaken)
            assert taken[0].ticks < taken[-1].ticks
            state = await it.end(FIRST)
            for at, snapshot in enumerate((taken[0], taken[-1], taken[0])):
                it.wake(snapshot.number, 10 + at, None)
                there = await it.back(10 + at)
                assert there.ticks == len(it.prints(FIRST)) // FINGERPRINT_BYTES
                assert there.inputs == 2
                assert it.of(10 + at, child_messages.Differs) == []
                assert await it.end(10 + at) == state


async def test_copies_of_a_run_with_a_camera_hear_the_same_pictures() -> None:
    """Its action writes a hash of the bytes of all pictures to the blackboard."""
    project = random_project(random.Random(WITH_CAMERA))  # noqa: S311 - a test
    assert project.has_camera
    with tempfile.TemporaryDirectory() as folder:
        unpack(project.app, Path(folder))
        async with runs() as it:
            await it.begin(Path(folder), universe=project.universe, robot=project.robot)
            await it.until(lambda: any(s.draws for s in it.of(FIRST, child_messages.SnapshotTaken)))
            await it.pause(FIRST)
            drawn = it.of(FIRST, child_messages.SnapshotTaken)[-1]
            state = await it.end(FIRST)
            it.wake(drawn.number, 2, None)
            await it.back(2)
            assert it.of(2, child_messages.Differs) == []
            assert await it.end(2) == state


async def test_a_snapshot_survives_who_made_it_and_its_copies_make_snapshots_too() -> None:
    with app_folder() as folder:
        async with runs() as it:
            await it.begin(folder)
            await it.until(lambda: len(it.prints(FIRST)) >= 100 * FINGERPRINT_BYTES)
            first = it.of(FIRST, child_messages.SnapshotTaken)[0]
            pid = next(pid for pid in it.supervisor.pids if psutil.Process(pid).name() != SNAPSHOT_NAME)
            os.kill(pid, signal.SIGKILL)
            await it.until(lambda: it.exited(FIRST))
            it.wake(first.number, 2, 2.0)
            there = await it.back(2)
            assert (there.ticks, it.of(2, child_messages.Differs)) == (41, [])
            it.tell(2, child_messages.KeepSnapshots(is_on=True))
            it.resume(2)
            await it.ticks(2, 120)
            known = it.prints(FIRST)[41 * FINGERPRINT_BYTES :]
            await it.pause(2)
            copied = it.prints(2)
            shared = min(len(known), len(copied))
            assert shared > 40 * FINGERPRINT_BYTES
            assert copied[:shared] == known[:shared]
            it.tell(2, child_messages.TakeSnapshot())
            await it.until(lambda: any(s.is_wanted for s in it.of(2, child_messages.SnapshotTaken)))
            own = it.of(2, child_messages.SnapshotTaken)[-1]
            assert own.ticks >= 120
            it.wake(own.number, 3, None, child=2)
            await it.back(3)
            assert it.of(3, child_messages.Differs) == []


ENTITIES = """
        if self.number == {0}:
            from std_msgs.msg import String
            from std_srvs.srv import Trigger
            node, self.ask = self.own_node, Trigger.Request()
            self.heard = node.create_subscription(
                String, "/word", lambda m: self.digest.update(m.data.encode()), 10
            )
            self.word = node.create_publisher(String, "/word", 10)
            self.timer = node.create_timer(0.11, lambda: self.word.publish(String(data="tick")))
            self.service = node.create_service(Trigger, "/ask", lambda _, answer: answer)
            self.client = node.create_client(Trigger, "/ask")
        if self.number > {0}:
            self.client.call_async(self.ask).add_done_callback(lambda f: self.digest.update(b"answer"))
"""


@pytest.mark.parametrize("number", [3, 90])
async def test_what_is_created_in_the_graph_before_and_after_the_fork_works(number: int) -> None:
    """The hash of all that the action hears has the timer, the topic and the service in it."""
    more = (
        ENTITIES.format(number, number)
        .replace("Trigger_request()", "__import__('std_srvs.srv', fromlist=['Trigger']).Trigger.Request()")
        .replace("node = self.node", "node = self.own_node")
    )
    with app_folder(more) as folder:
        async with runs() as it:
            await it.begin(folder)
            await it.ticks(FIRST, 260)
            await it.pause(FIRST)
            assert it.of(FIRST, child_messages.Fault) == []
            between = [s for s in it.of(FIRST, child_messages.SnapshotTaken) if s.ticks < 80]
            state = await it.end(FIRST)
            it.wake(between[-1].number, 2, None)
            await it.back(2)
            assert it.of(2, child_messages.Differs) == []
            assert await it.end(2) == state


async def test_a_run_with_a_thread_of_its_own_has_no_snapshots_and_says_why() -> None:
    more = """
        if self.number == 5:
            import threading
            threading.Thread(target=threading.Event().wait, name="grabber", daemon=True).start()
"""
    with app_folder(more) as folder:
        async with runs() as it:
            await it.begin(folder)
            await it.until(lambda: it.of(FIRST, child_messages.NoSnapshots))
            (refused,) = it.of(FIRST, child_messages.NoSnapshots)
            assert "“grabber”" in refused.reason
            number = len(it.of(FIRST, child_messages.SnapshotTaken))
            it.tell(FIRST, child_messages.TakeSnapshot())
            await it.until(lambda: len(it.of(FIRST, child_messages.NoSnapshots)) == 2)
            assert len(it.of(FIRST, child_messages.SnapshotTaken)) == number


@pytest.mark.kills
async def test_nothing_is_left_when_the_manager_is_killed() -> None:
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open()
        at = await ready(client, exact(hashing_app()))
        await client.ask("set_speed", {"speed": 0.0})
        await client.event("tick", lambda d: d["n"] > 200, after=at)
        assert await client.ask("go_back", {"t": 3.0}) == "ack"
        there = psutil.Process(manager.pid).children(recursive=True)
        assert sum(process.name() == SNAPSHOT_NAME for process in there) >= 2
        os.kill(manager.pid, signal.SIGKILL)
        gone, left = await asyncio.to_thread(psutil.wait_procs, there, 20)
        assert left == []
        assert gone
