"""World and application in one participant of ROS."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from executor.headless.participants import NODE_NAME
from executor.ros.environment import lockstep_environment

ROOT = Path(__file__).parents[3]
SOURCE = """
from types import SimpleNamespace
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from executor.headless.participants import Participants

world = SimpleNamespace(time_s=0.0, robots=[], universe=SimpleNamespace(robots=[]))
waited = []


class WorldEnd:
    def __init__(self, context):
        self.node = Node("world", context=context)
        self.node.create_subscription(String, "/said", lambda m: None, 10)

    def make_way(self, topic, message_type):
        pass

    def close(self):
        self.node.destroy_node()


def advance():
    world.time_s += 0.5
    waited.append(world.time_s)


ros = Participants(world, WorldEnd, advance)
assert rclpy.ok()
heard = []
ros.application.create_subscription(String, "/answer", lambda m: heard.append(m.data), 10)
publisher = ros.node.node.create_publisher(String, "/answer", 10)
publisher.publish(String(data="at once"))
ros.executor.drain()
assert heard == ["at once"], heard
rclpy.spin_once(ros.application, timeout_sec=1.0)
assert waited == [0.5, 1.0], waited
ros_name = ros.application.get_name()
ros.close()
ros.close()
assert not rclpy.ok()
print(ros_name)
"""


def test_messages_arrive_at_once_and_waits_let_time_pass() -> None:
    environment = {**os.environ, **lockstep_environment(), "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", SOURCE], env=environment, cwd=ROOT, capture_output=True, check=False, text=True
    )
    assert done.stdout.endswith(f"{NODE_NAME}\n"), done.stderr
