"""A world without physics: simulated time passes while it runs, and `/cmd_vel` is counted."""

from __future__ import annotations

import argparse
import os
import time
from typing import Any

import msgspec

from executor.supervision.channel import Channel, ChannelClosed
from executor.supervision.confine import die_with_parent
from executor.supervision.pulse import Pulse

PERIOD_S = 0.02


class ClockWorld:
    def __init__(self, channel, pulse, mute_after_s):
        import rclpy
        from geometry_msgs.msg import Twist
        from rclpy.context import Context
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rosgraph_msgs.msg import Clock

        self.channel = channel
        self.pulse = pulse
        self.mute_after_s = mute_after_s
        self.context = Context()
        rclpy.init(context=self.context, domain_id=int(os.environ["ROS_DOMAIN_ID"]))
        self.node = Node("fake_world", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.publisher = self.node.create_publisher(Clock, "/clock", 10)
        self.node.create_subscription(Twist, "/cmd_vel", self.heard, 10)
        self.message = Clock()
        self.time_s, self.is_running, self.last = 0.0, False, None

    def heard(self, twist):
        self.last = twist.linear.x

    def run(self):
        due = time.monotonic()
        self.pulse.rests()
        while True:
            self.pulse.moved()
            message = self.channel.receive(max(0.0, due - time.monotonic()))
            if message is not None:
                if message["type"] == "stop":
                    return
                self.obey(message)
                continue
            due += PERIOD_S
            if self.is_running:
                self.advance(PERIOD_S)
            self.executor.spin_once(timeout_sec=0)

    def advance(self, dt_s):
        self.time_s += dt_s
        self.message.clock.sec = int(self.time_s)
        self.message.clock.nanosec = int(self.time_s % 1 * 1e9)
        if self.time_s < self.mute_after_s:
            self.pulse.clocks += 1
            self.publisher.publish(self.message)

    def obey(self, message):
        self.do(message)
        if "request" in message:
            self.channel.send({"type": "answer", "request": message["request"]})

    def do(self, message):
        match message["type"]:
            case "start":
                self.channel.send({"type": "starting"})
                self.channel.send({"type": "ready", "renderer": "none", "tf": False, "universe": "Clock"})
            case "pause" | "resume":
                self.is_running = message["type"] == "resume"
                self.channel.send({"type": "log", "level": "info", "text": f"cmd_vel {self.last}"})
            case "step":
                self.advance(message["dt_s"])
            case "reset":
                self.time_s = 0.0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--channel-fd", type=int, required=True)
    parser.add_argument("--mute-after", type=float, default=float("inf"))
    arguments = parser.parse_args()
    die_with_parent()
    channel: Channel[Any, Any] = Channel(arguments.channel_fd, msgspec.msgpack.decode)
    try:
        ClockWorld(channel, Pulse(channel.send), arguments.mute_after).run()
    except ChannelClosed:
        return


if __name__ == "__main__":
    main()
