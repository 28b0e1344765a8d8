"""Real processes that die or are stopped while the debugger holds the tree: the ladder comes true."""

from __future__ import annotations

import asyncio
import os
import random
import signal
import sys
import time

import psutil
import pytest

from executor.session.hangs.vitals import FAULT_AFTER_S
from executor.session.ladder import State
from executor.session.runs.recording import MOST_LOST
from tests.budget import count
from tests.executor.hanging import ROOT, hanging_session, own_hanging_session
from tests.executor.session_client import SessionClient, manager_process, run_data
from tests.tree_gardener.debugging.hooked import free_port
from tree_gardener.groot.client import Groot2Client, SilenceError

pytestmark = pytest.mark.simulation

LEFT = {"world": State.CONNECTED, "application": State.VISUALIZATION_READY}


def chance_of_today():
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    return random.Random(seed)  # noqa: S311


VICTIMS = ("application", "world", "recorder")
OF_A_SESSION = len(VICTIMS) * MOST_LOST
"""A session replaces its recorder no more often."""


@pytest.mark.kills
async def test_a_process_that_is_killed_while_the_tree_is_held_is_reported_and_replaced():
    left = count("held_kills")
    while left > 0:
        async with own_hanging_session() as session:
            for number in range(min(left, OF_A_SESSION)):
                await kill(session, VICTIMS[number % len(VICTIMS)])
            left -= OF_A_SESSION
            await session.ask("set_breakpoints", {"breakpoints": []})
            await session.runs()


async def kill(session, kind):
    """Kills a process while the tree is held, and waits until the session has reported and replaced it."""
    await session.climb(State.HELD)
    victim = await session.spare(kind)
    at, began_s = len(session.client.events), time.monotonic()
    os.kill(victim.pid, signal.SIGKILL)
    if kind in LEFT:
        come = await session.client.event("state-changed", lambda d: d["state"] == LEFT[kind], after=at)
        [fault] = [each for each in session.client.named("fault", after=at) if each["kind"] == "process"]
        assert "ended at once" in fault["message"]
    else:
        come = await session.client.event("recording_stopped", lambda d: d["goes_on"], after=at)
        assert session.client.state == State.HELD
    sys.stdout.write(f"{kind}: true after {come['at'] - began_s:.2f} s\n")
    await session.spare(kind, other_than=victim.pid)


async def test_a_process_that_is_stopped_while_the_tree_is_held_is_reported():
    chance = chance_of_today()
    async with hanging_session() as session:
        for _ in range(count("held_stops")):
            outcome = await session.stop_child(chance.choice(["application", "world"]), State.HELD)
            sys.stdout.write(f"{outcome.victim}: {outcome.reported_s:.2f} s, {outcome.right_s:.2f} s\n")
        await session.ask("set_breakpoints", {"breakpoints": []})
        await session.runs()


async def test_a_tree_that_is_held_for_long_is_not_called_hung():
    async with hanging_session() as session:
        await session.climb(State.HELD)
        at = len(session.client.events)
        await asyncio.sleep(2 * FAULT_AFTER_S)  # the time is the test: a hang is reported after half of it
        assert session.client.named("fault", after=at) == []
        assert session.client.state == State.HELD
        await session.ask("continue_run")
        await session.ask("terminate_application")


@pytest.mark.kills
async def test_a_page_that_is_gone_leaves_the_tree_held_and_a_killed_manager_leaves_nothing():
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open(stream=False)
        assert await client.ask("set_breakpoints", {"breakpoints": [ROOT]}) == "ack"
        assert await client.ask("run", run_data()) == "ack"
        await client.event("held")
        await client.close()
        other = await SessionClient(manager.ready["port"]).open(stream=False)
        snapshot = (await other.event("snapshot"))["data"]
        assert (snapshot["state"], snapshot["held"]["uid"]) == ("held", 1)
        family = psutil.Process(manager.pid).children(recursive=True)
        manager.kill()
        _, alive = await asyncio.to_thread(psutil.wait_procs, family, 60)
        assert alive == []


async def test_groot2_looks_at_a_tree_while_it_is_held_and_while_it_runs_and_no_longer():
    port = free_port()
    async with hanging_session() as session:
        await session.climb(State.HELD)
        taken = await session.client.ask("serve_groot2", {"port": session.client.port})
        assert taken["code"] == "port_taken"
        await session.ask("serve_groot2", {"port": port})
        assert session.client.named("groot2") == [{"port": port}]
        assert await asyncio.to_thread(look, port) == 1
        await session.ask("set_breakpoints", {"breakpoints": []})
        await session.ask("continue_run")
        await session.runs()  # another run is served, too
        assert await asyncio.to_thread(look, port) == 1
        await session.ask("serve_groot2", {"port": 0})
        with pytest.raises(SilenceError):
            await asyncio.to_thread(look, port)


def look(port):
    """Returns the first uid of the tree that a client of Groot2's protocol sees."""
    with Groot2Client("127.0.0.1", port) as client:
        return client.tree().nodes[0].uid
