import cmath
import math

import py_trees
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input, set_output


class FindYard(py_trees.behaviour.Behaviour):
    """Finds the yard by its fence, and says where posts and dock are for odometry, which drifts."""

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "posts": Port(
            str, default="1,1; -1,1", description="Points in m, from the middle of the yard: x,y; x,y; …"
        ),
        "dock": Port(str, default="0,0", description="The dock in m, from the middle of the yard: x,y"),
    }
    OUTPUT_PORTS = {
        "posts_now": Port(str, description="The posts in m, in the frame of the odometry: x,y; x,y; …"),
        "dock_x": Port(float, description="The dock, in m, in the frame of the odometry."),
        "dock_y": Port(float, description="The dock, in m, in the frame of the odometry."),
    }

    def setup(self, **kwargs):
        # A point on the floor is a complex number here: adding moves it, multiplying turns it.
        self.robot, self.heading, self.is_turning = None, 0.0, True
        self.middle, self.turned = 0j, 0.0
        node: Node = kwargs["node"]
        self.odometry = node.create_subscription(Odometry, "/odom", self.on_odometry, 10)
        self.scan = node.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_odometry(self, odometry: Odometry):
        position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        self.robot = complex(position.x, position.y)
        self.heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        self.is_turning = abs(odometry.twist.twist.angular.z) > 0.2

    def on_scan(self, scan: LaserScan):
        # While it turns, the heading is older than the scan.
        if self.robot is None or self.is_turning:
            return
        seen = [
            self.robot + cmath.rect(distance, self.heading + scan.angle_min + i * scan.angle_increment)
            for i, distance in enumerate(scan.ranges)
            if scan.range_min < distance < scan.range_max
        ]
        # The fence has right angles: four times its direction is the same for all sides.
        ways = [b - a for a, b in zip(seen, seen[6:], strict=False) if 0 < abs(b - a) < 1]
        side = cmath.phase(sum(way**4 / abs(way) ** 3 for way in ways)) / 4 if ways else 0.0
        self.turned += 0.2 * math.remainder(side - self.turned, math.pi / 2)
        # Seen along its sides, the fence is a box, and its middle is that of the yard.
        straight = [point * cmath.rect(1, -self.turned) for point in seen]
        xs, ys = [point.real for point in straight], [point.imag for point in straight]
        if xs and max(xs) - min(xs) > 6.5 and max(ys) - min(ys) > 5.2:
            middle = complex(max(xs) + min(xs), max(ys) + min(ys)) / 2 * cmath.rect(1, self.turned)
            self.middle += 0.2 * (middle - self.middle)

    def now(self, point):
        x, y = (float(number) for number in point.split(","))
        return self.middle + complex(x, y) * cmath.rect(1, self.turned)

    def update(self):
        posts = [self.now(post) for post in get_input(self, "posts").split(";") if post.strip()]
        set_output(self, "posts_now", "; ".join(f"{post.real:.3f},{post.imag:.3f}" for post in posts))
        dock = self.now(get_input(self, "dock"))
        set_output(self, "dock_x", dock.real)
        set_output(self, "dock_y", dock.imag)
        return py_trees.common.Status.SUCCESS
