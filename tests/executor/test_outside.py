"""The universe `none`: the application drives a robot of an outside ROS graph."""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys

import pytest

from executor.child_messages import StartApplication, StartWorld
from executor.manager.manager import outside_domain_id
from tests.executor.session.play import DATA, Play
from tests.executor.session_client import ROOT, run_data
from tests.executor.warm import warm_session


@contextlib.asynccontextmanager
async def outside_robot(domain_id):
    """Runs a plain program, with nothing of ROS in its environment but its domain."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "FAST"))}
    process = await asyncio.create_subprocess_exec(
        sys.executable,
        str(ROOT / "tests" / "fakes" / "outside_robot.py"),
        stdout=asyncio.subprocess.PIPE,
        env=environment | {"ROS_DOMAIN_ID": str(domain_id)},
    )
    try:
        yield process.stdout
    finally:
        process.kill()
        await process.wait()


async def named_end(client, topic, end):
    """Returns the nodes at an end of a topic; DDS may announce topics before the names of their nodes."""
    async with asyncio.timeout(60):
        while True:
            assert await client.ask("list_topics") == "ack"
            rows = {row["name"]: row for row in client.named("topics")[-1]["topics"]}
            if names := rows.get(topic, {}).get(end):
                return names
            await asyncio.sleep(0.2)  # the rate of this command is limited


@pytest.mark.simulation
async def test_the_application_drives_an_outside_robot_and_a_pause_stops_it():
    async def told(robot, condition):
        async with asyncio.timeout(60):
            while not condition(float((await robot.readline()).split()[1])):
                pass

    async with (
        warm_session(stream=False) as (manager, client),
        outside_robot(manager.outside_domain_id) as robot,
    ):
        assert await client.ask("run", run_data(universe="none")) == "ack"
        await told(robot, lambda speed: speed > 0)
        assert (await named_end(client, "/scan", "publishers")) == ["/outside_robot"]
        assert "/outside_robot" in await named_end(client, "/cmd_vel", "subscribers")

        assert await client.ask("pause") == "ack"
        await told(robot, lambda speed: speed == 0)
        refused = await client.ask("move_body", {"id": "x", "pose": [0] * 6})
        assert "no simulated world" in refused["message"]
        assert await client.ask("resume") == "ack"
        await told(robot, lambda speed: speed > 0)
        assert await client.ask("terminate_application") == "ack"
        await told(robot, lambda speed: speed == 0)


@pytest.mark.parametrize(("asked", "domain"), [({}, 7), ({"domain_id": 12}, 12)])
def test_both_processes_go_into_the_outside_domain(asked, domain):
    play = Play()
    object.__setattr__(play.session.about, "outside_domain_id", 7)
    play.command("run", **DATA["run"] | {"universe": {"universe": "none", **asked}})
    told = [getattr(effect, "message", None) for effect in play.effects]
    starts = [each for each in told if isinstance(each, StartApplication | StartWorld)]
    assert [start.domain_id for start in starts] == [domain, domain]
    assert [start.outside for start in starts if isinstance(start, StartApplication)] == [True]
    assert play.reply(play.command("run")) == "ack"
    assert play.session.run.domain_id == play.session.about.ros_domain_id


def test_the_outside_domain_is_that_of_the_environment(monkeypatch):
    for text, expected in [("", 0), ("42", 42), ("-1", 0), ("x", 0), ("9999", 0)]:
        monkeypatch.setenv("ROS_DOMAIN_ID", text)
        assert outside_domain_id() == expected
