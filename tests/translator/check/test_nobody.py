"""Actions that subscribe to what nobody publishes, or call what nobody serves."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.translator.check.finding import findings
from translator.check.nobody import check_nobody

ACTION = """import py_trees
from sensor_msgs.msg import Image, LaserScan
from std_srvs.srv import Empty
from nav2_msgs.action import Spin
from rclpy.action import ActionClient


class Act(py_trees.behaviour.Behaviour):
    TOPIC = "/cam_f1_left/image_raw"

    def setup(self, **kwargs):
        node = kwargs["node"]
        {line}

    def update(self):
        return py_trees.common.Status.SUCCESS
"""
CAMERA = "node.create_subscription(Image, self.TOPIC, print, 10)"
ROBOT = """format: bt-studio/robot
version: 1
name: Own
urdf: own.urdf
sensors:
  - {kind: camera, link: eye, topic: /cam_f1_left/image_raw}
"""


@pytest.fixture
def found(make_project):
    def look(line, files=None, **settings):
        project = make_project({"n1": {"type": "Act"}}, actions={"Act": ACTION.format(line=line)})
        settings = project.settings.model_copy(update={"universe": "walled_room", **settings})
        project = replace(project, settings=settings, files={**project.files, **(files or {})})
        return findings(check_nobody, project)

    return look


def test_a_topic_of_nobody_is_said_with_the_sensor_that_the_robot_has(found):
    [item] = found(CAMERA, robot="waffle")
    assert item.code == "BT0623"
    assert item.message == (
        "Act subscribes to /cam_f1_left/image_raw, which nobody publishes here; "
        "this robot's camera is /camera/image_raw."
    )
    assert (item.place.file, item.place.line) == ("actions/Act.py", 13)
    assert item.values["universe"] == ""


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ('node.create_subscription(Sonar, "/sonar", print, 1)', "BT0624"),
        ('node.create_client(Empty, "open_door")', "BT0625"),
        ('ActionClient(node, Spin, "/dance")', "BT0625"),
    ],
)
def test_what_no_robot_has_is_said_without_a_remedy(found, line, code):
    assert [item.code for item in found(line)] == [code]


@pytest.mark.parametrize(
    "line",
    [
        'node.create_subscription(LaserScan, "scan", print, 10)',
        'node.create_subscription(Image, "~/own", print, 10)',
        'node.create_subscription(Image, kwargs["topic"], print, 10)',
        'ActionClient(node, Spin, "spin")',
        'node.create_client(Empty, "/controller/set_parameters")',
        'node.create_publisher(Image, "/a", 1); node.create_subscription(Image, "/a", print, 1)',
        'node.create_publisher(Image, kwargs["a"], 1); node.create_subscription(Image, "/a", print, 1)',
    ],
)
def test_what_is_there_or_not_known_is_no_finding(found, line):
    assert found(line) == []


@pytest.mark.parametrize(
    ("files", "settings"),
    [
        ({}, {"universe": "none"}),
        ({"launch/own.launch.yaml": b"launch: []"}, {}),
        ({"universes/own.yaml": b"not: [closed"}, {"universe": "own"}),
        ({"robots/own/robot.yaml": ROBOT.encode()}, {"robot": "own"}),
        ({}, {"robot": "unknown"}),
        (
            {"universes/own.yaml": b"robots: [{topics: {camera: /cam_f1_left/image_raw}}]"},
            {"universe": "own"},
        ),
    ],
)
def test_other_worlds_may_have_it(found, files, settings):
    assert found(CAMERA, files, **settings) == []


def test_a_universe_of_the_project_is_named_for_the_fix(found):
    [item] = found(CAMERA, {"universes/own.yaml": b"robots: [{model: waffle}]"}, universe="own")
    assert item.values["universe"] == "universes/own.yaml"
