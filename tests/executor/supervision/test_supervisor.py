"""Well-behaved and hostile children: no process is left, and the reason is reported."""

from __future__ import annotations

import asyncio
import contextlib
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import psutil
import pytest

from executor.child_messages import name_of
from executor.session.events import ChildExited, ChildLooked, ChildSaid, Kill, Retire, Spawn, Tell
from executor.supervision.processes import ChildProcess, Limits, Program
from executor.supervision.supervisor import Supervisor
from tests.executor.tools.test_groups import unreaped
from tests.processes import with_word

ROOT = Path(__file__).parents[3]
FAKE = ROOT / "tests" / "fakes" / "child.py"


def program(habit, **limits):
    return Program((sys.executable, str(FAKE), habit), {"PYTHONPATH": str(ROOT)}, Limits(**limits))


def fakes_alive():
    """Returns the fake children that still live."""
    children = psutil.Process().children(recursive=True)
    return with_word(FAKE.name, children)


class Stage:
    def __init__(self, habit, kind="application", *, reaps_all=False, **limits):
        self.kind = kind
        self.events: asyncio.Queue[Any] = asyncio.Queue()
        self.frames: list[Any] = []
        self.seen = []
        self.supervisor = Supervisor(
            {kind: program(habit, **limits)},
            self.events.put_nowait,
            self.frames.append,
            reaps_all=reaps_all,
        )
        self.supervisor.apply(Spawn(kind, 1))

    def tell(self, type_, **fields):
        message: Any = {"type": type_, **fields}  # the child is a fake, which takes any fields
        self.supervisor.apply(Tell(self.kind, 1, message))

    async def until(self, wanted):
        async with asyncio.timeout(60):
            while True:
                event = await self.events.get()
                self.seen.append(event)
                if wanted(event):
                    return event

    async def exit(self):
        return await self.until(lambda e: isinstance(e, ChildExited))

    async def said(self, type_):
        return await self.until(lambda e: isinstance(e, ChildSaid) and name_of(e.message) == type_)


@contextlib.asynccontextmanager
async def stage(habit, kind="application", **limits):
    it = Stage(habit, kind, **limits)
    try:
        yield it
    finally:
        await it.supervisor.close()
        assert fakes_alive() == []


async def test_a_child_s_group_is_ended_before_its_number_is_free(monkeypatch):
    """Afterwards no signal is sent to it: it may be that of another process."""
    was_its_own = unreaped(monkeypatch)
    heard: list[Any] = []
    sleeping = Program((sys.executable, "-c", "import time; time.sleep(1000)"), {}, Limits())
    child = await ChildProcess.spawn(sleeping, heard.append)
    child.kill()
    await child.wait()
    child.kill()
    child.ask_to_end()
    assert was_its_own == [False, True]  # it runs; it has exited and is not reaped


async def test_a_good_child_answers_and_stops_on_request():
    async with stage("good", "world") as it:
        it.tell("start")
        await it.said("ready")
        it.tell("subscribe", client="c", stream="poses")
        it.tell("list_topics", request="q1")
        await it.said("answer")
        assert [f.stream for f in it.frames] == ["poses"]
        it.tell("stop")
        it.supervisor.apply(Retire("world", 1, 5.0))
        assert (await it.exit()).reason == "ended with exit code 0"


@pytest.mark.parametrize(
    "message",
    [{"type": "tick"}, {"type": "tick", "n": "x"}, {"type": "nonsense"}, {"type": "log", "level": 3}, {}],
)
async def test_a_child_whose_message_does_not_decode_is_ended(message):
    async with stage("good") as it:
        it.tell("start")
        await it.said("ready")
        it.tell("say", message=message)
        assert "broke its channel (a message does not decode: " in (await it.exit()).reason


@pytest.mark.parametrize(
    ("habit", "reason"), [("dies_at_start", "exit code 3"), ("dies_when_started", "exit code 4")]
)
async def test_a_child_that_dies_reports_its_code_and_last_lines(habit, reason):
    async with stage(habit) as it:
        it.tell("start")
        event = await it.exit()
        assert reason in event.reason
        assert event.last_lines == ("last words",)


@pytest.mark.parametrize("habit", ["never_ready", "ignores_signals", "good"])
async def test_any_child_can_be_killed(habit):
    async with stage(habit) as it:
        it.supervisor.apply(Kill("application", 1))
        assert (await it.exit()).reason == "was ended"


async def test_a_child_that_ignores_stop_is_ended_after_its_grace():
    async with stage("ignores_signals") as it:
        it.supervisor.apply(Retire("application", 1, 0.2))
        assert (await it.exit()).reason == "was ended"


async def test_a_child_killed_from_outside_is_reported_in_words():
    async with stage("good") as it:
        it.tell("start")
        await it.said("ready")
        os.kill(it.supervisor.pids[0], 9)
        assert (await it.exit()).reason.startswith("was ended at once")


@pytest.mark.parametrize(
    ("habit", "reason"), [("closes_pipe", "closed its channel"), ("talks_rubbish", "broke its channel")]
)
async def test_a_child_without_a_channel_is_ended(habit, reason):
    async with stage(habit) as it:
        assert reason in (await it.exit()).reason


async def test_a_flood_of_output_is_limited_and_counted():
    async with stage("floods") as it:
        it.tell("start")
        await it.said("ready")
        it.tell("stop")
        await it.exit()
        logs = [e for e in it.seen if isinstance(e, ChildSaid) and name_of(e.message) == "log"]
        assert 1000 <= len(logs) < 5000


async def test_a_daemon_that_left_the_group_is_ended_too():
    async with stage("daemon") as it:
        it.tell("start")
        await it.said("ready")
        it.tell("stop")
        await it.exit()
        assert fakes_alive() == []


async def test_too_many_processes_are_ended():
    async with stage("forks", processes=20) as it:
        it.tell("start")
        assert "more than the 20 allowed" in (await it.exit()).reason


async def test_too_much_memory_is_refused_to_the_process():
    async with stage("leaks", memory_bytes=300 << 20) as it:
        it.tell("start")
        event = await it.exit()
        assert "exit code 1" in event.reason or "memory" in event.reason


@pytest.mark.parametrize(
    ("habit", "limits", "reason"),
    [
        ("burns", {"cpu_s": 1}, "was ended: it used more than the 1 s of CPU time allowed"),
        ("writes", {"file_bytes": 3 << 20}, "was ended: it wrote a file of more than the 3 MB allowed"),
    ],
)
async def test_a_limit_that_is_hit_is_named(habit, limits, reason):
    async with stage(habit, **limits) as it:
        it.tell("start")
        assert (await it.exit()).reason == reason


async def test_a_program_that_does_not_exist_is_reported():
    events: asyncio.Queue[Any] = asyncio.Queue()
    supervisor = Supervisor({"world": Program(("/does/not/exist",))}, events.put_nowait, print)
    supervisor.apply(Spawn("world", 1))
    event = await asyncio.wait_for(events.get(), 60)
    assert "could not be started" in event.reason
    await supervisor.close()


def ended_process():
    """Returns the id of a child of this process that has ended with the status 7."""
    pid = os.fork()
    if not pid:
        os._exit(7)
    os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)
    return pid


def status_of(pid):
    _, status = os.waitpid(pid, os.WNOHANG)
    return os.waitstatus_to_exitcode(status)


async def test_the_status_of_a_process_that_somebody_waits_for_is_left_to_them():
    async with stage("good", reaps_all=True) as it:
        with it.supervisor.starting_others():
            awaited = ended_process()
            for _ in range(3):
                await it.until(lambda e: isinstance(e, ChildLooked))
            assert status_of(awaited) == 7
        orphan = ended_process()
        while psutil.pid_exists(orphan):
            await it.until(lambda e: isinstance(e, ChildLooked))


def test_children_die_with_their_manager():
    script = f"""
import asyncio, sys, time
sys.path.insert(0, {str(ROOT)!r})
from tests.executor.supervision.test_supervisor import Stage
async def main():
    it = Stage("good")
    it.tell("start")
    await it.said("ready")
    print(it.supervisor.pids[0], flush=True)
    await asyncio.sleep(60)
asyncio.run(main())
"""
    manager = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    child = psutil.Process(int(manager.stdout.readline()))
    manager.kill()
    manager.wait()
    manager.stdout.close()
    gone, alive = psutil.wait_procs([child], timeout=60)
    assert (len(gone), alive) == (1, [])
