"""The topics that leaves command."""

from __future__ import annotations

import pytest

from translator.action import inspect_action
from translator.check.commands import absolute, commanded_by, commanded_by_block
from translator.tree import Node

SOURCE = """
import py_trees
from geometry_msgs.msg import {type}
from std_msgs.msg import String


class A(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        self.one = kwargs["node"].create_publisher({type}, "{topic}", 10)
        self.two = kwargs["node"].create_publisher(String, "/log", 10)

    def update(self):
        return py_trees.common.Status.RUNNING
"""


def action(**values):
    return inspect_action(SOURCE.format(**values), "actions/A.py")


def test_an_action_commands_by_the_type_or_the_name_of_its_topic():
    assert commanded_by(action(type="Twist", topic="drive")) == {"/drive"}
    assert commanded_by(action(type="Pose", topic="/arm_cmd")) == {"/arm_cmd"}
    assert commanded_by(action(type="Pose", topic="/goal")) == frozenset()
    assert commanded_by(inspect_action("x = 1", "actions/A.py")) == frozenset()


def test_what_was_read_is_kept():
    assert commanded_by(action(type="Twist", topic="a")) is commanded_by(action(type="Twist", topic="a"))


@pytest.mark.parametrize(
    ("ports", "topics"),
    [
        ({"topic_name": "/cmd_vel", "topic_type": "geometry_msgs/Twist"}, {"/cmd_vel"}),
        ({"topic_name": "drive", "topic_type": "geometry_msgs/msg/TwistStamped"}, {"/drive"}),
        ({"topic_name": "{topic}", "topic_type": "geometry_msgs/msg/Twist"}, set()),
        ({"topic_name": "/say", "topic_type": "std_msgs/msg/String"}, set()),
    ],
)
def test_a_block_that_publishes(ports, topics):
    assert commanded_by_block(Node("n", "RosPublish", ports=ports)) == topics
    assert absolute("a") == absolute("/a") == "/a"
