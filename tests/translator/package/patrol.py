"""A project with all that a package can hold: a library behaviour, launch files, programs beside the tree."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from tests.translator.conftest import ROOT
from translator import Ros2Package, load, to_ros2_package

if TYPE_CHECKING:
    from pathlib import Path

NAME = "patrol"
LAUNCH_FILE = "nodes (of my) röbot.launch.yaml"
SPEED = 0.75  # rad/s

SAY = """
import py_trees
from std_msgs.msg import String


class Say(py_trees.behaviour.Behaviour):
    TOPIC = "/said"

    def __init__(self, name, ports=None):
        super().__init__(name)
        self.ports = ports

    def setup(self, **kwargs):
        node = kwargs["node"]
        self.text = node.declare_parameter("text", "on patrol").value
        self.publisher = node.create_publisher(String, self.TOPIC, 10)
        self.heard = node.create_subscription(String, self.ports["ear"], print, 10)

    def update(self):
        self.publisher.publish(String(data=self.text))
        return py_trees.common.Status.SUCCESS
"""
TALKER = """
import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
node.declare_parameter("rate", 1.0)
node.declare_parameter("text", "hello")
publisher = node.create_publisher(String, "/chatter", 10)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""
LAUNCH = """launch:
  - arg: {name: rate, default: "4.0"}
  - node:
      exec: launch/my talker.py  # with a blank
      name: talker
      param: [{name: rate, value: $(var rate)}]
  - node: {exec: "$(dirname)/tools/it's.py", name: flow, namespace: inner,
           param: [{from: "$(dirname)/flow.yaml"}]}
"""
PARAMETERS = "/**:\n  ros__parameters:\n    rate: 8.0\n"


def patrol() -> Ros2Package:
    """Returns the package."""
    look = {"type": "LookAround", "ports": {"speed": str(SPEED), "timeout": "1000"}}
    nodes = {
        "n1": {"type": "Sequence", "children": ["n2", "n3"]},
        "n2": {"type": "Say", "ports": {"ear": "/ear"}},
        "n3": look,
    }
    settings = {"format": "bt-studio/project", "version": 1, "name": "Patrol"}
    diagram = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "n1", "nodes": nodes}
    library = ROOT / "backend" / "catalog" / "behaviours" / "actions" / "LookAround.py"
    files = {
        "project.json": json.dumps(settings).encode(),
        "trees/MainTree.json": json.dumps(diagram).encode(),
        "actions/Say.py": SAY.encode(),
        "actions/LookAround.py": library.read_bytes(),
        f"launch/{LAUNCH_FILE}": LAUNCH.encode(),
        "launch/flow.yaml": PARAMETERS.encode(),
        "launch/my talker.py": TALKER.encode(),
        "launch/tools/it's.py": TALKER.encode(),
    }
    package = to_ros2_package(load(files))
    assert package.name == NAME
    return package


def write(package: Ros2Package, folder: Path) -> None:
    """Writes the package into the `src` of a workspace."""
    for path, raw in package.files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(raw)
