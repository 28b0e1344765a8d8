"""Builds the world of an exact run in a process of its own, and prints what it finds."""

from __future__ import annotations

import json
import sys
from contextlib import nullcontext
from types import SimpleNamespace
from typing import Any

from executor.child_messages import StartApplication, StartWorld
from executor.exact.world import ExactWorld
from executor.ros.environment import use_lockstep_environment
from executor.world.commands import WorldCommands


def build(state: bytes) -> tuple[ExactWorld, list[str], list[Any]]:
    ticks: list[str] = []
    sent: list[Any] = []
    pulse: Any = SimpleNamespace(busy=nullcontext)
    commands = WorldCommands(sent.append, pulse)
    start = StartApplication("", 20.0, world=StartWorld("walled_room", seed=3), world_state=state)
    world = ExactWorld(
        start,
        tick=lambda: ticks.append("tick"),
        is_ticking=lambda: True,
        send=sent.append,
        commands=commands,
        recorder="",
    )
    assert commands.loop is world.loop
    return world, ticks, sent


def main() -> None:
    from geometry_msgs.msg import Twist

    world, ticks, _ = build(b"")
    node = world.ros.application
    heard: list[float] = []
    publisher = node.create_publisher(Twist, "/cmd_vel", 10)
    from nav_msgs.msg import Odometry

    node.create_subscription(Odometry, "/odom", lambda m: heard.append(m.pose.pose.position.x), 10)
    message = Twist()
    message.linear.x = 0.3
    for _ in range(20):
        publisher.publish(message)
        world.loop.tick()
        world.ros.executor.drain()
    state, time_s, x = world.world.dump(), world.world.time_s, world.world.robots[0].pose[0]
    world.close()
    world.ros.close()
    again, *_ = build(state)
    result = {"ticks": len(ticks), "heard": heard, "time_s": time_s, "x": x}
    result["again"] = [again.world.time_s, again.world.robots[0].pose[0], again.loop.next_tick_step]
    sys.stdout.write(json.dumps(result))


use_lockstep_environment()
main()
