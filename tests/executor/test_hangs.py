"""Real processes that are stopped on some rung: the hang is reported, and the session recovers."""

from __future__ import annotations

import asyncio
import os
import random
import signal
import sys
from typing import Any

import pytest

from executor.session.ladder import State
from tests.budget import count
from tests.executor.hanging import CASES, hanging_session

pytestmark = pytest.mark.simulation


def cases_of_today():
    """Returns as many cases as the budget allows, evenly over all states, drawn at random."""
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    chance, wanted = random.Random(seed), count("hangs_real")  # noqa: S311
    found: list[Any] = []
    while len(found) < wanted:
        found += chance.sample(CASES, len(CASES))
    return found[:wanted]


async def test_a_stopped_process_is_reported_and_the_session_comes_right():
    async with hanging_session() as session:
        for kind, state in cases_of_today():
            outcome = await session.stop_child(kind, state)
            sys.stdout.write(
                f"{kind} in {state}: reported after {outcome.reported_s:.2f} s, "
                f"right after {outcome.right_s:.2f} s\n"
            )
        await session.ask("set_breakpoints", {"breakpoints": []})  # it may have been held at one
        await session.runs()


@pytest.mark.parametrize(("kind", "how"), [("application", signal.SIGSTOP), ("world", signal.SIGKILL)])
async def test_a_run_takes_another_spare_where_the_first_is_lost(kind, how):
    async with hanging_session() as session:
        await session.climb(State.IDLE)
        lost = await session.spare(kind)
        os.kill(lost.pid, how)
        await session.runs()
        assert session.child(kind).pid != lost.pid
        assert [f for f in session.client.named("fault") if f["kind"] != "timeout"] == []


@pytest.mark.parametrize(
    ("state", "command"), [(State.APPLICATION_RUNNING, "pause"), (State.PAUSED, "resume")]
)
async def test_a_stopped_world_answers_nothing_and_a_continued_one_works(state, command):
    async with hanging_session() as session:
        await session.climb(state)
        world = session.child("world")
        os.kill(world.pid, signal.SIGSTOP)
        replies = await asyncio.gather(session.client.ask(command), session.client.ask("reset_world"))
        os.kill(world.pid, signal.SIGCONT)
        assert [reply["code"] for reply in replies] == ["not_answering", "not_answering"]
        assert "is stopped" in replies[0]["message"]
        await session.client.event("log", lambda d: d["text"] == "The simulated world answers again.")
        assert session.client.state == state
        await session.ask(command)
        assert session.child("world").pid == world.pid
