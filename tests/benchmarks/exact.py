"""Exact sessions: going back, the pause and the cost of snapshots, *Apply*, Run to motion, and memory.

`python -m tests.benchmarks exact`. All but the ratios need an idle machine.
"""

from __future__ import annotations

import asyncio
import math
import statistics
import sys
import time
from typing import TYPE_CHECKING, Any, Final

import psutil

from executor import child_messages
from executor.messages import Poses, Scene
from executor.session.events import ChildSaid
from executor.supervision.copies import SNAPSHOT_NAME
from tests.benchmarks.figures import Figure, of_parts, show
from tests.benchmarks.timing import processor_s, pss_mb
from tests.executor.application.real_application import UPDATE_RUNNING, app
from tests.executor.exact.exact_runs import app_folder
from tests.executor.exact.test_process import exact, ready
from tests.executor.exact.test_snapshots import FIRST, Runs
from tests.executor.session_client import SessionClient, app_zip, manager_process, run_data

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable, Iterable, Sequence

LAST_MINUTE_S: Final = (599.0, 590.0, 580.0, 570.0, 560.0, 550.0, 541.0)
EARLIER_S: Final = (500.0, 431.0, 333.0, 250.0, 177.0, 90.0, 10.0)
RUN_S: Final = 600
TICK_HZ: Final = 20
PICTURES: Final = {"stream": "camera", "max_hz": 10.0, "width": 640}
WATCHED_S: Final = 20.0
SNAPSHOTS: Final = 30
STARTS: Final = 5
SPARE_S: Final = 4.0
MOVED_M: Final = 0.002
NODES: Final = 600
APPLIES: Final = 10


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields every figure; `--parts back motion` leaves the other parts out."""
    parts = {
        "back": lambda: _of(
            going_back("laser_bump_and_go", "walled_room", None),
            going_back("visual_follow_person", "person_in_green", PICTURES),
        ),
        "forks": lambda: _of(forks()),
        "memory": lambda: _of(memory()),
        "applying": lambda: _of(applying(is_exact=False), applying(is_exact=True)),
        "motion": lambda: _of(motion()),
    }
    return of_parts(parts, options)


def _of(*parts: AsyncIterator[Figure]) -> Iterable[Figure]:
    async def all_of(part: AsyncIterator[Figure]) -> list[Figure]:
        return [figure async for figure in part]

    for part in parts:
        yield from asyncio.run(all_of(part))


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


async def going_back(example: str, universe: str, stream: dict[str, Any] | None) -> AsyncIterator[Figure]:
    """Makes a run of ten minutes as fast as possible, and goes back in it; then the snapshots only wait."""
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open()
        if stream is not None:
            assert await client.ask("subscribe", stream) == "ack"
        await ready(client, exact(app_zip(example), universe=universe))
        assert await client.ask("set_speed", {"speed": 0.0}) == "ack"
        assert await client.ask("pause") == "ack"
        few = await waiting(manager.pid)
        began_s = time.monotonic()
        assert await client.ask("resume") == "ack"
        await client.event("tick", lambda d: d["n"] >= RUN_S * TICK_HZ, timeout_s=600)
        yield Figure(f"{example}: {RUN_S} s of simulation", time.monotonic() - began_s, "s")
        assert await client.ask("pause") == "ack"
        for when, (share, count) in (("at first", few), ("at the end", await waiting(manager.pid))):
            yield Figure(f"{example}: manager and waiting snapshots, {when}, of a core", share, "%")
            yield Figure(f"{example}: waiting snapshots, {when}", count, "")
        for what, moments in (("the last minute", LAST_MINUTE_S), ("ten minutes", EARLIER_S)):
            times = [await back_s(client, t) for t in moments]
            yield Figure(f"{example}: back within {what}, median", statistics.median(times), "s")
            yield Figure(f"{example}: back within {what}, worst", max(times), "s")
        await client.close()


async def back_s(client: SessionClient, t: float) -> float:
    """Returns the real time in s until the run is back at a moment."""
    began_s = time.monotonic()
    answer = await client.ask("go_back", {"t": t}, timeout_s=120)
    assert answer == "ack", answer
    return time.monotonic() - began_s


async def waiting(pid: int) -> tuple[float, int]:
    """Returns the share of a core in % of a paused session's manager and snapshots, and their number."""
    family = psutil.Process(pid)
    snapshots = [each for each in family.children(recursive=True) if each.name() == SNAPSHOT_NAME]
    watched = [family, *snapshots]
    before = processor_s(*watched)
    await asyncio.sleep(WATCHED_S)
    return 100 * (processor_s(*watched) - before) / WATCHED_S, len(snapshots)


class TimedRuns(Runs):
    """Runs that know when each message came."""

    def __init__(self) -> None:
        super().__init__()
        self.times: list[tuple[float, Any]] = []

    def report(self, event: Any) -> None:
        if isinstance(event, ChildSaid):
            self.times.append((time.monotonic(), event.message))
        super().report(event)


async def forks() -> AsyncIterator[Figure]:
    """Times the pause of a run by a snapshot: from the message of its tick to that of the snapshot."""
    with app_folder() as folder:
        it = TimedRuns()
        try:
            await it.begin(folder)
            await it.until(lambda: len(it.of(FIRST, child_messages.SnapshotTaken)) >= SNAPSHOTS)
            await it.end(FIRST)
        finally:
            await it.supervisor.close()
    pauses, tick_s = [], math.inf
    for at_s, message in it.times:
        if isinstance(message, child_messages.Tick):
            tick_s = at_s
        elif isinstance(message, child_messages.SnapshotTaken) and tick_s < at_s:
            pauses.append((at_s - tick_s) * 1000)
    yield Figure("pause of a run by a snapshot, median", statistics.median(pauses), "ms")
    yield Figure("pause of a run by a snapshot, largest", max(pauses), "ms")


async def memory() -> AsyncIterator[Figure]:
    """The memory of a whole session in the warehouse, without its snapshots."""
    for what, data in (
        ("exact", exact(app_zip(), universe="warehouse")),
        ("live", run_data(app_zip(), universe="warehouse")),
    ):
        async with manager_process() as manager:
            client = await SessionClient(manager.ready["port"]).open()
            await ready(client, data)
            await client.event("tick", lambda d: d["n"] >= 10 * TICK_HZ)
            family = psutil.Process(manager.pid).children(recursive=True)
            of_snapshots = sum(pss_mb(each.pid) for each in family if each.name() == SNAPSHOT_NAME)
            whole = pss_mb(manager.pid)
            parts_of = "manager, recorder, spare and world"
            yield Figure(f"warehouse, {what} session: {parts_of} (PSS)", whole - of_snapshots, "MB")
            yield Figure(f"warehouse, {what} session: snapshots (PSS)", of_snapshots, "MB")
            await client.close()


async def applying(*, is_exact: bool) -> AsyncIterator[Figure]:
    """Replaces a tree of 600 nodes while it ticks; counts the periods of ticks that were missed."""
    data = run_data(app(UPDATE_RUNNING, tree(0)))
    data["application"]["on_finish"] = "repeat"
    if is_exact:
        data["universe"] |= {"time": "exact", "seed": 7}
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open(stream=False)
        at = await ready(client, data)
        durations = []
        for number in range(1, APPLIES + 1):
            await asyncio.sleep(1.0)
            began_s = time.monotonic()
            changed = app(UPDATE_RUNNING, tree(number))
            assert await client.ask("apply", {"app_zip_base64": changed}) == "ack"
            durations.append(time.monotonic() - began_s)
        await asyncio.sleep(1.0)
        ticks = [(e["data"]["n"], e["t"]) for e in client.events[at:] if e["command"] == "tick"]
        (first, begin_s), (last, end_s) = ticks[0], ticks[-1]
        missed = round((end_s - begin_s) * TICK_HZ) - (last - first)
        where = f"*Apply* of {NODES} nodes, {'exact' if is_exact else 'live'}"
        yield Figure(f"{where}: ticks missed in {APPLIES}", missed, "")
        yield Figure(f"{where}: to the answer, median", statistics.median(durations) * 1000, "ms")
        yield Figure(f"{where}: to the answer, largest", max(durations) * 1000, "ms")
        await client.close()


def tree(number: int) -> str:
    """Returns a tree of so many nodes, of which one has changed and one is new."""
    leaves = "".join(f"<AlwaysSuccess _bts_id='n{i}'/>" for i in range(NODES - 3))
    return (
        f"<Sequence _bts_id='s'>{leaves}<AlwaysSuccess _bts_id='new{number}'/><Act _bts_id='a'/></Sequence>"
    )


async def motion() -> AsyncIterator[Figure]:
    """The time from Run to motion with spares that are ready: the first run of a session, and the next.

    The spare application of a new session is for a live run; later spares are for the kind of the last run.
    """
    times: dict[str, list[float]] = {}
    for _ in range(STARTS):
        for what, data in (("live", run_data()), ("exact", exact())):
            async with manager_process() as manager:
                client = await SessionClient(manager.ready["port"]).open()
                await client.ask("subscribe", {"stream": "poses", "max_hz": 30.0})
                await asyncio.sleep(SPARE_S)
                times.setdefault(f"first, {what}", []).append(await run_to_motion_s(client, data))
                assert await client.ask("terminate_application") == "ack"
                await asyncio.sleep(SPARE_S)
                times.setdefault(f"next, {what}", []).append(await run_to_motion_s(client, data))
                await client.close()
    for what, found in times.items():
        yield Figure(f"Run to motion, {what}, median", statistics.median(found), "s")
        yield Figure(f"Run to motion, {what}, worst", max(found), "s")


async def run_to_motion_s(client: SessionClient, data: dict[str, Any]) -> float:
    """Returns the real time in s from Run until the robot moves."""
    began_s = time.monotonic()
    assert await client.ask("run", data) == "ack"
    client.frames[:] = [each for each in client.frames if isinstance(each[1], Scene)]
    await client.until(lambda: any(isinstance(each, Poses) for _, each in client.frames))
    await client.until(motion_of(client))
    return time.monotonic() - began_s


def motion_of(client: SessionClient) -> Callable[[], bool]:
    """Returns a function that says whether the robot is no more where it was at first."""
    places: list[Any] = []

    def has_moved() -> bool:
        now = client.robot_position()
        if now is not None:
            places.append(now[:2])
        return bool(places) and math.dist(places[0], places[-1]) > MOVED_M

    return has_moved


if __name__ == "__main__":
    main()
