import math

import py_trees
from nav_msgs.msg import Odometry
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class AtGoal(py_trees.behaviour.Behaviour):
    """Succeeds if the robot is at the goal, by odometry."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "x": Port(float, required=True, description="The goal, in m from where the robot started."),
        "y": Port(float, required=True, description="The goal, in m from where the robot started."),
        "within": Port(float, default=0.4, description="How near is there, in m."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.place = None
        self.subscription = node.create_subscription(Odometry, "/odom", self.on_odometry, 10)

    def on_odometry(self, odometry: Odometry):
        self.place = (odometry.pose.pose.position.x, odometry.pose.pose.position.y)

    def update(self):
        if self.place is None:
            return py_trees.common.Status.FAILURE
        left = math.dist(self.place, (get_input(self, "x"), get_input(self, "y")))
        is_there = left <= get_input(self, "within")
        return py_trees.common.Status.SUCCESS if is_there else py_trees.common.Status.FAILURE
