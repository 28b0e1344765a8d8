"""A whole session with the real world and the real application: laser bump and go."""

from __future__ import annotations

import asyncio
import math
import os
import signal

import psutil
import pytest

from executor.messages import Poses, Scan, Scene
from tests.executor.session_client import SessionClient, manager_process, run_data
from tests.executor.warm import warm_session
from tests.processes import with_word

pytestmark = pytest.mark.simulation


def child_of(manager, kind):
    (child,) = with_word(f"executor.{kind}.process", psutil.Process(manager.pid).children())
    return child


def moved(client, start, distance_m):
    position = client.robot_position()
    return position is not None and math.dist(start[:2], position[:2]) > distance_m


async def start(client):
    for stream in ("poses", "scan"):
        assert await client.ask("subscribe", {"stream": stream}) == "ack"
    assert await client.ask("run", run_data()) == "ack"
    begin = await client.until(client.robot_position)
    await client.until(lambda: moved(client, begin, 0.1))


async def test_run_pause_step_resume_stop_and_run_again():
    async with warm_session() as (manager, client):
        await start(client)
        assert any(isinstance(frame, Scene) for _, frame in client.frames)
        assert any(isinstance(frame, Scan) for _, frame in client.frames)
        assert (await client.event("sim"))["data"]["collisions"] == 0

        assert await client.ask("pause") == "ack"
        place = await settled(client)
        at, frames = len(client.events), len(client.frames)
        # The world reports about once a second, also while it is paused.
        await client.event("sim", lambda data: data["paused"], after=at)
        await client.event("sim", lambda data: data["paused"], after=len(client.events))
        assert client.named("tick", after=at) == []
        assert [f for _, f in client.frames[frames:] if isinstance(f, Poses)] == []
        assert client.robot_position() == place

        assert await client.ask("step") == "ack"
        await client.event("tick", after=at)
        assert await client.ask("resume") == "ack"
        await client.until(lambda: moved(client, place, 0.1))

        assert await client.ask("terminate_application") == "ack"
        assert client.state == "visualization_ready"
        assert child_of(manager, "world").is_running()
        at = len(client.events)
        assert await client.ask("run", run_data()) == "ack"
        await client.event("tick", lambda d: d["n"] > 5, after=at)
        assert await client.ask("disconnect") == "ack"
        living = [c for c in psutil.Process(manager.pid).children() if c.status() != psutil.STATUS_ZOMBIE]
        assert living == [child_of(manager, "recorder")]  # what was recorded can still be read


async def settled(client):
    """Returns the robot's position once it does not change between two reports of a paused world."""
    async with asyncio.timeout(60):
        while True:
            place = client.robot_position()
            for _ in range(2):  # a single report may follow at once
                await client.event("sim", lambda data: data["paused"], after=len(client.events))
            if place is not None and place == client.robot_position():
                return place


async def test_topics_are_listed_echoed_published_and_described():
    async with warm_session() as (manager, client):
        assert client.named("introspection")[0]["ros_environment"]["ROS_DOMAIN_ID"] == str(
            manager.ready["domain_id"]
        )
        await start(client)
        assert await client.ask("list_topics") == "ack"
        rows = {t["name"]: t for t in client.named("topics")[-1]["topics"]}
        assert {"/scan", "/odom", "/cmd_vel", "/clock"} <= set(rows)
        assert rows["/cmd_vel"]["publishers"] == ["/bt_application"]
        assert rows["/scan"]["subscribers"] == ["/bt_application"]

        assert await client.ask("echo_topic", {"topic": "/odom", "max_hz": 5}) == "ack"
        message = (await client.event("topic_message"))["data"]
        assert message["type"] == "nav_msgs/msg/Odometry"
        assert message["message"]["child_frame_id"] == "base_footprint"
        rate = None
        while not rate:  # the first list starts the measurement
            assert await client.ask("list_topics") == "ack"
            rate = next(t["hz"] for t in client.named("topics")[-1]["topics"] if t["name"] == "/odom")
            await asyncio.sleep(0.2)  # the rate of this command is limited
        assert (await client.ask("echo_topic", {"topic": "/ghost"}))["code"] == "unknown_topic"

        twist = "geometry_msgs/msg/Twist"
        assert await client.ask("describe_type", {"type": twist}) == "ack"
        assert set(client.named("type_description")[0]["example"]) == {"linear", "angular"}
        wrong = {"topic": "/cmd_vel", "type": twist, "message": {"linear": {"x": "fast"}}}
        reply = await client.ask("publish_topic", wrong)
        assert (reply["code"], reply["message"].startswith("linear.x: must be a number")) == (
            "bad_message",
            True,
        )

        assert await client.ask("terminate_application") == "ack"
        place = await settled(client)
        right = {"topic": "/cmd_vel", "type": twist, "message": {"linear": {"x": 0.3}}}
        assert (await client.ask("publish_topic", right))["code"] == "world_paused"
        assert await client.ask("move_body", {"id": "ghost", "pose": [0] * 6}) != "ack"
        assert await settled(client) == place  # the world is paused

        assert await client.ask("run_world") == "ack"
        assert await client.ask("publish_topic", right) == "ack"
        while (await client.event("sim"))["data"]["pose"] == place:
            pass
        assert await client.ask("terminate_application") == "ack"
        place = await settled(client)
        assert await settled(client) == place


@pytest.mark.parametrize(("kind", "state"), [("world", "connected"), ("application", "visualization_ready")])
async def test_a_killed_process_is_reported_and_a_second_run_works(kind, state):
    async with warm_session() as (manager, client):
        await start(client)
        at = len(client.events)
        os.kill(child_of(manager, kind).pid, signal.SIGKILL)
        fault = (await client.event("fault", after=at))["data"]
        assert (fault["kind"], "ended at once" in fault["message"]) == ("process", True)
        await client.event("state-changed", lambda d: d["state"] == state, after=at)
        assert await client.ask("run", run_data()) == "ack"
        begin = client.robot_position()
        await client.until(lambda: moved(client, begin, 0.1))


@pytest.mark.kills
async def test_nothing_outlives_a_manager_that_is_killed():
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open()
        await start(client)
        family = psutil.Process(manager.pid).children(recursive=True)
        manager.kill()
        await manager.wait()
        assert psutil.wait_procs(family, timeout=60)[1] == []
        await client.close()
