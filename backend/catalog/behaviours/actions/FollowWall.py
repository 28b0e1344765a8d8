import math

import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class FollowWall(py_trees.behaviour.Behaviour):
    """Drives along a wall at a distance, round inner and outer corners, until it is halted."""

    INPUT_PORTS = {
        "side": Port(str, default="left", description="On which side the wall is: left or right."),
        "distance": Port(float, default=0.6, description="How far from the wall, in m."),
        "speed": Port(float, default=0.25, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.had_wall = False
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def initialise(self):
        self.had_wall = False

    def nearest(self, low, high):
        """Returns the nearest distance between two bearings in degrees.

        If there is none, the largest range.
        """
        scan, found = self.scan, self.scan.range_max
        for i, distance in enumerate(scan.ranges):
            bearing = math.degrees(math.remainder(scan.angle_min + i * scan.angle_increment, math.tau))
            if low <= bearing <= high and scan.range_min <= distance < found:
                found = distance
        return found

    def update(self):
        if self.scan is None:
            return py_trees.common.Status.RUNNING
        left = 1 if get_input(self, "side") != "right" else -1
        wanted, speed = get_input(self, "distance"), get_input(self, "speed")
        ahead = self.nearest(-25, 25)
        side = self.nearest(60, 120) if left > 0 else self.nearest(-120, -60)
        front_side = self.nearest(25, 65) if left > 0 else self.nearest(-65, -25)
        twist = Twist()
        if ahead < 1.3 * wanted:
            twist.angular.z = -left * 0.8
        elif min(side, front_side) > 2.5 * wanted:
            # No wall is near yet, or it ended: continue ahead, and round the end.
            twist.linear.x = speed
            twist.angular.z = left * 0.6 * speed / wanted if self.had_wall else 0.0
        else:
            self.had_wall = True
            # Where the wall runs parallel, the oblique beam is √2 times as long as the one to the side.
            error = min(side, front_side / math.sqrt(2)) - wanted
            twist.linear.x = speed
            twist.angular.z = left * max(-0.8, min(0.8, 1.6 * error))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
