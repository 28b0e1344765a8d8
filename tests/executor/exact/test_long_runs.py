"""A long exact run keeps its snapshots and its memory within their bounds, and still goes back."""

from __future__ import annotations

import logging
from typing import NamedTuple

import psutil
import pytest

from executor.session.exact.ring import CEILING_BYTES, MOST
from executor.supervision.copies import SNAPSHOT_NAME
from executor.supervision.room import private_bytes
from tests.budget import count
from tests.executor.exact.exact_runs import working_app
from tests.executor.exact.test_process import exact, ready
from tests.executor.session_client import SessionClient, manager_process

pytestmark = pytest.mark.simulation

log = logging.getLogger(__name__)

TICK_HZ = 20
# One snapshot may be made while those that have become too many are dropped.
BEING_MADE = 2
WARM_MINUTES = 10
GROWTH_BYTES = 64 << 20


class Sample(NamedTuple):
    """The processes of a session at one moment: number and own memory of its snapshots, memory of all."""

    snapshots: int
    own_bytes: int
    all_bytes: int


@pytest.mark.timeout(3000)  # an hour of simulated time takes some ten minutes
async def test_a_long_run_stays_within_its_bounds_and_goes_back() -> None:
    minutes = count("exact_minutes")
    samples: list[Sample] = []
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open(stream=False)
        await ready(client, exact(working_app(tick_work_s=0.005)))
        assert await client.ask("set_speed", {"speed": 0.0}) == "ack"
        for minute in range(1, minutes + 1):
            ticks = minute * 60 * TICK_HZ
            await client.event("tick", lambda d, ticks=ticks: d["n"] >= ticks, timeout_s=300)
            client.events.clear()
            samples.append(sample(manager.pid))
        assert await client.ask("pause") == "ack"
        for t in (minutes * 60.0 - 30, 10.0):
            assert await client.ask("go_back", {"t": t}, timeout_s=120) == "ack"
        await client.close()
    log.info("%s", samples)
    assert max(each.snapshots for each in samples) > 3
    assert max(each.snapshots for each in samples) <= MOST + BEING_MADE
    assert max(each.own_bytes for each in samples) <= CEILING_BYTES * (MOST + BEING_MADE) / MOST
    if minutes > WARM_MINUTES:
        assert samples[-1].all_bytes - samples[WARM_MINUTES - 1].all_bytes < GROWTH_BYTES


def sample(pid: int) -> Sample:
    """Returns what a manager and its processes use now."""
    family = psutil.Process(pid).children(recursive=True)
    snapshots = [each.pid for each in family if is_snapshot(each)]
    pids = [pid, *(each.pid for each in family)]
    return Sample(len(snapshots), sum(map(private_bytes, snapshots)), sum(map(shared_bytes, pids)))


def is_snapshot(process: psutil.Process) -> bool:
    """Returns whether a process is a snapshot that has not ended meanwhile."""
    try:
        return process.name() == SNAPSHOT_NAME
    except psutil.NoSuchProcess:
        return False


def shared_bytes(pid: int) -> int:
    """Returns the proportional memory of a process; 0 if it has ended meanwhile."""
    try:
        return int(psutil.Process(pid).memory_full_info().pss)
    except (psutil.NoSuchProcess, FileNotFoundError):
        return 0
