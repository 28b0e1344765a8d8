"""Exact runs with real processes: they equal runs in lock-step, and come right after what goes wrong."""

from __future__ import annotations

import asyncio
import contextlib
import os
import random
import shutil
import signal
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import psutil
import pytest
from mcap.reader import make_reader

from executor.exact import process
from executor.headless.recorded_segments import recorded_segments
from executor.manager.manager import Manager, ManagerSettings
from executor.manager.programs import session_programs
from executor.recorder.cdr import decode
from executor.supervision.copies import SNAPSHOT_NAME
from tests.executor.session_client import ROOT, TOKEN, SessionClient, app_zip, run_data
from tests.executor.warm import warm_session
from tests.processes import with_word

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.simulation

FORWARD = (ROOT / "examples/laser_bump_and_go/actions/Forward.py").read_text()
RANDOM = """
        import random
        import numpy
        self.count = getattr(self, "count", 0) + 1
        if self.count % 10 == 0:
            print(random.random(), numpy.random.random(), {"a", "b", "c", "d"})
        twist.angular.z = random.uniform(-0.2, 0.2)
"""
SEED = 7


def forward(more: str) -> str:
    """Returns the action with more in its update, before it publishes."""
    head, publish, tail = FORWARD.partition("        self.publisher.publish(twist)\n")
    return head + more.lstrip("\n") + publish + tail


def exact(app: str | None = None, **more: Any) -> dict[str, Any]:
    data = run_data(app, **more)
    data["universe"] |= {"time": "exact", "seed": SEED}
    return data


def rows(path: Path) -> dict[str, dict[int, list[Any]]]:
    """Returns the messages of a recording by topic and time: of the log what actions printed."""
    found: dict[str, dict[int, list[Any]]] = {}
    with path.open("rb") as file:
        for schema, channel, message in make_reader(file).iter_messages(log_time_order=False):
            assert schema is not None
            data: Any = message.data
            if channel.topic == "/bt/tick":
                data = decode(schema.name, data) | {"duration_ms": 0.0}
            elif channel.topic == "/bt/log":
                data = decode(schema.name, data)
                if data["source"] != "action":
                    continue
            found.setdefault(channel.topic, {}).setdefault(message.log_time, []).append(data)
    return found


@contextlib.asynccontextmanager
async def recorded_session(file: Path):
    with recorded_segments(file) as folder:
        manager = Manager(ManagerSettings(port=0, token=TOKEN, recordings=folder, keeps_whole=True))
        client = SessionClient(await manager.start())
        try:
            yield await client.open()
            await client.close()
        finally:
            await manager.close()


async def handled(client: SessionClient, until_s: float) -> float:
    """Handles a run at random until a time, with views that come and go; returns its last time in s."""
    chance = random.Random(SEED)  # noqa: S311 - a test

    def now_s() -> float:
        return float(max((e["t"] for e in client.events if e["command"] == "tick"), default=0.0))

    while now_s() < until_s:
        match chance.randrange(5):
            case 0:
                await client.ask("set_speed", {"speed": chance.choice([0.5, 1.0, 3.0, 10.0])})
            case 1:
                assert await client.ask("pause") == "ack"
                for _ in range(chance.randrange(3)):
                    assert await client.ask("step") == "ack"
                assert await client.ask("resume") == "ack"
            case 2:
                await client.ask("subscribe", {"stream": chance.choice(["scan", "camera", "view"])})
            case 3:
                await client.ask("unsubscribe", {"stream": chance.choice(["scan", "camera", "view"])})
            case _:
                ticks = len(client.named("tick"))
                await client.until(lambda ticks=ticks: len(client.named("tick")) > ticks + 3)
    assert await client.ask("pause") == "ack"
    return now_s()


async def test_a_run_that_is_looked_at_and_handled_equals_one_in_lock_step(tmp_path):
    project = tmp_path / "project"
    shutil.copytree(ROOT / "examples/laser_bump_and_go", project)
    (project / "actions/Forward.py").write_text(forward(RANDOM))
    data = exact(app_zip(Forward=forward(RANDOM)))
    async with recorded_session(tmp_path / "exact.mcap") as client:
        for stream in ("poses", "scan"):
            await client.ask("subscribe", {"stream": stream})
        assert await client.ask("run", data) == "ack"
        end_s = await handled(client, 15.0)
        assert await client.ask("disconnect") == "ack"
        assert any(e["command"] == "log" and "0." in e["data"]["text"] for e in client.events)
    command = [
        sys.executable,
        "-m",
        "backend.cli.main",
        "run",
        str(project),
        "--lockstep",
        "--seed",
        str(SEED),
    ]
    command += ["--duration", str(end_s + 1.0), "--record", str(tmp_path / "lockstep.mcap")]
    environment = {**os.environ, "PYTHONHASHSEED": "0"}
    done = await asyncio.to_thread(
        subprocess.run,
        command,
        env=environment,
        cwd=ROOT,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr.decode()

    ours, theirs = rows(tmp_path / "exact.mcap"), rows(tmp_path / "lockstep.mcap")
    last = round(end_s * 1e9) - 1  # at the last moment the run is ended by hand
    for topic in ("/bt/tick", "/cmd_vel", "/scan"):
        mine = {t: data for t, data in ours[topic].items() if t < last}
        assert mine == {t: data for t, data in theirs[topic].items() if t < last}, topic
        assert len(mine) > 100
    # The recorder moves a line that is later than what it has; its text is that of the action.
    printed = [line["text"] for lines in ours["/bt/log"].values() for line in lines]
    assert len(printed) > 20
    assert printed == [line["text"] for lines in theirs["/bt/log"].values() for line in lines][: len(printed)]
    for topic in ("/odom", "/imu", "/joint_states"):  # nobody takes them, so they are recorded as samples
        mine = {t: data for t, data in ours[topic].items() if t < last}
        assert len(mine) > 20
        assert mine == {t: theirs[topic][t] for t in mine}, topic


SLOW = """
        import time
        time.sleep(0.03)
"""


async def test_the_recording_of_a_slow_run_has_each_tick_at_its_time_also_after_a_reset(tmp_path):
    async with recorded_session(tmp_path / "exact.mcap") as client:
        data = exact(app_zip(Forward=forward(SLOW)))
        data["universe"]["speed"] = 10.0  # faster than the machine can
        at = await ready(client, data)
        await client.event("tick", lambda d: d["n"] > 20, after=at)
        assert await client.ask("reset_world") == "ack"
        at = len(client.events)
        await client.until(lambda: len(client.named("tick", after=at)) > 100)
        assert await client.ask("disconnect") == "ack"
    ticks = rows(tmp_path / "exact.mcap")["/bt/tick"]
    assert len(ticks) > 100
    assert {t: found for t, found in ticks.items() if {row["stamp"] for row in found} != {t}} == {}
    assert min(ticks) < 0.2e9, "the first ticks after a reset"


def child_of(manager: Any) -> psutil.Process:
    """Returns the process of the run: the first one of its program that is no snapshot, and has not ended."""
    runs = []
    for child in psutil.Process(manager.pid).children():
        with contextlib.suppress(psutil.Error), child.oneshot():
            is_run = any(process.__name__ in part for part in child.cmdline())
            if is_run and child.name() != SNAPSHOT_NAME:
                runs.append(child)
    return min(runs, key=psutil.Process.create_time)


async def ready(client: SessionClient, data: dict[str, Any]) -> int:
    """Runs, until the tree has ticked; returns the place in the events."""
    at = len(client.events)
    assert await client.ask("run", data) == "ack"
    await client.event("tick", after=at)
    return at


ENDS = {
    "import ctypes; ctypes.string_at(0)": "crashed",
    "import os; os._exit(3)": "exit code 3",
    "raise ValueError('boo')": "boo",
}
HANGS = {
    "while True: pass": "has not returned",
    "import time; time.sleep(600)": "has not returned",
    "import rclpy; rclpy.spin_until_future_complete(rclpy.create_node('x'), rclpy.task.Future())": "has not",
}
LATE = "        self.count = getattr(self, 'count', 0) + 1\n        if self.count == 5:\n            {}\n"


async def test_what_an_action_does_ends_the_run_and_not_the_session():
    async with warm_session() as (manager, client):
        for line, words in ENDS.items():
            at = await ready(client, exact(app_zip(Forward=forward(LATE.format(line)))))
            fault = await client.event("fault", after=at)
            assert words in fault["data"]["message"]
            await client.event("state-changed", lambda d: d["state"] == "visualization_ready", after=at)
        for line, words in HANGS.items():
            at = await ready(client, exact(app_zip(Forward=forward(LATE.format(line)))))
            waits = await client.event("log", lambda d: "The world waits for Forward" in d["text"], after=at)
            assert waits["data"]["node_path"].startswith("Forward")
            fault = await client.event("fault", lambda d: d["kind"] == "timeout", after=at)
            assert words in fault["data"]["message"]
            assert fault["data"]["file"] == "actions/Forward.py"
            assert await client.ask("terminate_application") == "ack"
            assert client.state == "visualization_ready"
        for number in (signal.SIGKILL, signal.SIGSTOP):
            at = await ready(client, exact())
            os.kill(child_of(manager).pid, number)
            await client.event("finished", lambda d: d["reason"] == "process_died", after=at)
            await client.event("state-changed", lambda d: d["state"] == "visualization_ready", after=at)
        at = await ready(client, exact())
        assert await client.ask("pause") == "ack"
        assert await client.ask("disconnect") == "ack"


async def test_the_world_goes_to_the_run_and_comes_back():
    async with warm_session() as (_, client):
        assert await client.ask("subscribe", {"stream": "poses"}) == "ack"
        await ready(client, exact())
        await client.until(lambda: (client.robot_position() or [0])[0] > 0.3)
        assert await client.ask("terminate_application") == "ack"
        at = len(client.events)
        left = (await client.event("sim", after=at))["data"]
        assert left["distance_m"] > 0.3
        assert await client.ask("restart_application") == "ack"
        again = (await client.event("sim", after=len(client.events)))["data"]
        assert again["distance_m"] >= left["distance_m"]
        assert await client.ask("reset_world") == "ack"
        await client.event("sim", lambda d: d["distance_m"] < 0.3, after=len(client.events))
        assert await client.ask("echo_topic", {"topic": "/odom", "max_hz": 5}) == "ack"
        assert (await client.event("topic_message"))["data"]["type"] == "nav_msgs/msg/Odometry"
        assert (await client.ask("move_body", {"id": "ghost", "pose": [0] * 6}))["code"] == "wrong_state"
        assert await client.ask("pause") == "ack"
        assert (await client.ask("move_body", {"id": "ghost", "pose": [0] * 6}))["code"] == "bad_request"
        assert await client.ask("disconnect") == "ack"


async def test_a_live_run_follows_an_exact_one():
    async with warm_session() as (manager, client):
        await ready(client, exact())
        at = await ready(client, run_data())
        await client.event("tick", lambda d: d["n"] > 5, after=at)
        assert with_word(process.__name__, psutil.Process(manager.pid).children()) == []


def test_its_hashes_are_those_of_a_run_in_lock_step():
    environment = session_programs(3)["exact"].environment
    assert environment["PYTHONHASHSEED"] == "0"
    assert environment["FASTDDS_DEFAULT_PROFILES_FILE"].endswith("lockstep.xml")
