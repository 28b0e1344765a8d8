"""A plain rclpy program in a process of its own: counts pictures, and reports them as JSON."""

import json
import sys
import time

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image, LaserScan

WANTED = int(sys.argv[1])
LIMIT_S = 180.0


class Listener(Node):
    """Subscribes to the first camera and the LIDAR."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.stamps: list[float] = []
        self.scans = 0
        self.made_s = time.monotonic()
        self.matched_s: float | None = None
        self.create_subscription(Image, "/camera/image_raw", self.on_image, qos_profile_sensor_data)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_image(self, image: Image) -> None:
        self.stamps.append(image.header.stamp.sec + image.header.stamp.nanosec * 1e-9)

    def on_scan(self, _: LaserScan) -> None:
        self.scans += 1

    def look(self) -> None:
        if self.matched_s is None and self.count_publishers("/camera/image_raw"):
            self.matched_s = time.monotonic() - self.made_s


def main() -> None:
    rclpy.init()
    listener = Listener()
    print(json.dumps({"ready": True}), flush=True)  # noqa: T201 - the result
    end_s = time.monotonic() + LIMIT_S
    while len(listener.stamps) < WANTED and time.monotonic() < end_s:
        listener.look()
        rclpy.spin_once(listener, timeout_sec=0.02)
    said = {"stamps": listener.stamps, "scans": listener.scans, "matched_s": listener.matched_s}
    print(json.dumps(said), flush=True)  # noqa: T201 - the result
    rclpy.shutdown()


main()
