import importlib

import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data

from tree_gardener.ports import Port, get_input


class WaitForTopic(py_trees.behaviour.Behaviour):
    """Waits for a message on a topic of any type; it fails after a timeout."""

    INPUT_PORTS = {
        "topic": Port(str, default="/scan", description="Name of the topic."),
        "timeout": Port(float, default=10.0, description="After how long it gives up, in s."),
    }

    def setup(self, **kwargs):
        self.node: Node = kwargs["node"]
        self.subscription = None
        self.arrived = False
        self.began_s = 0.0

    def now_s(self):
        return self.node.get_clock().now().nanoseconds / 1e9

    def initialise(self):
        self.arrived = False
        self.began_s = self.now_s()

    def on_message(self, _message):
        self.arrived = True

    def subscribe(self, topic):
        """Subscribes to the topic if it has a publisher, since the type is unknown before."""
        for name, types in self.node.get_topic_names_and_types():
            if name == topic:
                package, kind, message = types[0].split("/")
                message_class = getattr(importlib.import_module(f"{package}.{kind}"), message)
                self.subscription = self.node.create_subscription(
                    message_class, topic, self.on_message, qos_profile_sensor_data
                )

    def update(self):
        if self.subscription is None:
            self.subscribe(get_input(self, "topic"))
        if self.arrived:
            return py_trees.common.Status.SUCCESS
        is_late = self.now_s() - self.began_s > get_input(self, "timeout")
        return py_trees.common.Status.FAILURE if is_late else py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        if self.subscription is not None:
            self.node.destroy_subscription(self.subscription)
            self.subscription = None
