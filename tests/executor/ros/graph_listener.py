"""A plain rclpy program in a process of its own: receives the world's topics, and reports them as JSON."""

import json
import sys
import time
from functools import partial
from importlib import import_module
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

WANTED_S = float(sys.argv[1])
TOPICS = set(sys.argv[2].split(","))
LIMIT_S = 60.0


class Listener(Node):
    """Subscribes to each topic, with the type and the reliability that the graph declares."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.stamps: dict[str, list[float]] = {}
        self.frames: dict[str, str] = {}
        self.seen: dict[str, dict[str, Any]] = {}
        self.clock_s = 0.0

    def look(self) -> None:
        for name, types in self.get_topic_names_and_types():
            infos = self.get_publishers_info_by_topic(name)
            if name not in TOPICS or name in self.seen or not infos:
                continue
            qos = infos[0].qos_profile
            is_reliable = qos.reliability == ReliabilityPolicy.RELIABLE
            self.seen[name] = {"type": types[0], "reliable": is_reliable}
            wanted = QoSProfile(depth=50, reliability=qos.reliability, durability=qos.durability)
            self.stamps[name] = []
            package, _, kind_name = types[0].partition("/msg/")
            kind = getattr(import_module(f"{package}.msg"), kind_name)
            self.create_subscription(kind, name, partial(self.hear, name), wanted)

    def hear(self, name: str, message: Any) -> None:
        if name == "/clock":
            self.clock_s = message.clock.sec + message.clock.nanosec * 1e-9
        header = getattr(message, "header", None)
        if header is None and getattr(message, "transforms", None):
            header = message.transforms[0].header
        stamp = self.clock_s if header is None else header.stamp.sec + header.stamp.nanosec * 1e-9
        self.stamps[name].append(stamp)
        if header is not None:
            self.frames[name] = header.frame_id


def main() -> None:
    rclpy.init()
    listener = Listener()
    end_s = time.monotonic() + LIMIT_S
    while set(listener.seen) != TOPICS and time.monotonic() < end_s:
        listener.look()
        rclpy.spin_once(listener, timeout_sec=0.02)
    print(json.dumps({"ready": True}), flush=True)  # noqa: T201 - the result
    while listener.clock_s < WANTED_S and time.monotonic() < end_s:
        rclpy.spin_once(listener, timeout_sec=0.05)
    said = {"seen": listener.seen, "stamps": listener.stamps, "frames": listener.frames}
    print(json.dumps(said), flush=True)  # noqa: T201 - the result
    rclpy.shutdown()


main()
