"""Projects as people write them in JdeRobot's BT Studio.

Plain subscriptions (which are reliable), `tree_tools`, `cv_bridge`, `ports` in the constructor,
`Status.INVALID` before the first message.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from tests.fakes.react_diagrams import ROOT, Graph

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

BASE = """import geometry_msgs
import py_trees
import sensor_msgs
import tree_tools
{imports}

class {name}(py_trees.behaviour.Behaviour):
    def __init__(self, name, ports=None):
        super().__init__(name)
        self.ports = ports
        {made}

    def setup(self, **kwargs: int) -> None:
        try:
            self.node = kwargs["node"]
        except KeyError as error:
            raise KeyError("there is no node") from error
        {setup}

    def port(self, name):
        return tree_tools.get_port_content(self.ports[name])

    def initialise(self) -> None:
        self.logger.debug("initialise")

{body}
    def terminate(self, new_status: py_trees.common.Status) -> None:
        self.logger.debug(f"{{self.status}} -> {{new_status}}")
"""

VELOCITY = """self.publisher = self.node.create_publisher(
            msg_type=geometry_msgs.msg.Twist, topic="/cmd_vel", qos_profile=10
        )"""


def source(name: str, body: str, *, setup: str = "pass", made: str = "pass", imports: str = "") -> str:
    """Returns an action in that style."""
    lines = "".join(f"    {line}\n" if line else "\n" for line in body.strip("\n").split("\n"))
    return BASE.format(name=name, body=lines, setup=setup, made=made, imports=imports)


IS_NEAR = source(
    "IsNear",
    """
def heard(self, scan):
    self.scan = scan

def update(self):
    if len(self.scan.ranges) == 0:
        return py_trees.common.Status.INVALID
    width = int(self.port("width"))
    ahead = self.scan.ranges[:width] + self.scan.ranges[-width:]
    near = min(ahead) < float(self.port("distance"))
    return py_trees.common.Status.SUCCESS if near else py_trees.common.Status.FAILURE
""",
    made="self.scan = sensor_msgs.msg.LaserScan()",
    setup='self.ear = self.node.create_subscription(sensor_msgs.msg.LaserScan, "/scan", self.heard, 10)',
)
DRIVE = """
def update(self):
    speed = geometry_msgs.msg.Twist()
    speed.{field} = float(self.port("speed"))
    self.publisher.publish(speed)
    return py_trees.common.Status.RUNNING
"""
ADVANCE = source("Advance", DRIVE.format(field="linear.x"), setup=VELOCITY)
ROTATE = source("Rotate", DRIVE.format(field="angular.z"), setup=VELOCITY)

SEES_GREEN = source(
    "SeesGreen",
    """
def heard(self, picture):
    self.picture = self.bridge.imgmsg_to_cv2(picture, "bgr8")

def update(self):
    if self.picture is None:
        return py_trees.common.Status.INVALID
    colours = cv2.cvtColor(self.picture, cv2.COLOR_BGR2HSV)
    green = cv2.inRange(colours, np.array([40, 40, 20]), np.array([80, 255, 255]))
    if cv2.countNonZero(green) < 200:
        return py_trees.common.Status.FAILURE
    x, _, width, height = cv2.boundingRect(green)
    tree_tools.set_port_content(self.ports["middle"], x + width / 2)
    tree_tools.set_port_content(self.ports["height"], height)
    return py_trees.common.Status.SUCCESS
""",
    made="self.bridge, self.picture = CvBridge(), None",
    setup="""self.ear = self.node.create_subscription(
            sensor_msgs.msg.Image, "/depth_camera/image_raw", self.heard, 10
        )""",
    imports="import cv2\nimport numpy as np\nfrom cv_bridge import CvBridge\n",
)
APPROACH = source(
    "Approach",
    """
def update(self):
    error = 320 - float(self.port("middle"))
    speed = geometry_msgs.msg.Twist()
    speed.linear.x = max(0.0, min(0.5, (420 - float(self.port("height"))) * 0.005))
    speed.angular.z = error * 0.003
    self.publisher.publish(speed)
    return py_trees.common.Status.RUNNING
""",
    setup=VELOCITY,
)

SEES_RED = source(
    "SeesRed",
    """
def heard(self, picture):
    self.picture = self.bridge.imgmsg_to_cv2(picture, "bgr8")

def update(self):
    if self.picture is None:
        return py_trees.common.Status.INVALID
    red = cv2.inRange(self.picture[260:270], np.array([17, 15, 70]), np.array([50, 56, 255]))
    _, columns = np.nonzero(red)
    if len(columns) == 0:
        return py_trees.common.Status.FAILURE
    tree_tools.set_port_content(self.ports["column"], float(columns.mean()))
    return py_trees.common.Status.SUCCESS
""",
    made="self.bridge, self.picture = CvBridge(), None",
    setup="""self.ear = self.node.create_subscription(
            sensor_msgs.msg.Image, "/cam_f1_left/image_raw", self.heard, 10
        )""",
    imports="import cv2\nimport numpy as np\nfrom cv_bridge import CvBridge\n",
)
STEER = source(
    "Steer",
    """
def update(self):
    error = 320 - float(self.port("column"))
    speed = geometry_msgs.msg.Twist()
    speed.linear.x = max(4.0, 8.0 - abs(error) * 0.05)
    speed.angular.z = error * 0.01
    self.publisher.publish(speed)
    return py_trees.common.Status.RUNNING
""",
    setup=VELOCITY,
)
FORCES = source(
    "Forces",
    """
def scanned(self, scan):
    self.scan = scan

def moved(self, odometry):
    self.place = odometry.pose.pose

def update(self):
    if self.place is None or len(self.scan.ranges) < 180:
        return py_trees.common.Status.INVALID
    turned = 2 * math.atan2(self.place.orientation.z, self.place.orientation.w)
    goal = float(self.port("x")) - self.place.position.x, float(self.port("y")) - self.place.position.y
    bearing = math.atan2(goal[1], goal[0]) - turned
    ahead, left = 2 * math.cos(bearing), 2 * math.sin(bearing)
    for number, distance in enumerate(self.scan.ranges):
        push = 0.2 / 2.7 ** (2 * distance)
        ahead -= push * math.cos(math.radians(number - 90))
        left -= push * math.sin(math.radians(number - 90))
    speed = geometry_msgs.msg.Twist()
    speed.linear.x, speed.angular.z = max(0.0, ahead), left
    self.publisher.publish(speed)
    return py_trees.common.Status.RUNNING
""",
    made="self.scan, self.place = sensor_msgs.msg.LaserScan(), None",
    setup=VELOCITY
    + """
        self.ears = [
            self.node.create_subscription(sensor_msgs.msg.LaserScan, "/f1/laser/scan", self.scanned, 10),
            self.node.create_subscription(nav_msgs.msg.Odometry, "/odom", self.moved, 10),
        ]""",
    imports="import math\n\nimport nav_msgs\n",
)


def write_racer(folder: Path) -> Path:
    """Writes a project that follows a red line with the camera of the F1."""
    graph = Graph()
    graph.node("root", ROOT)
    graph.node("all", "ReactiveSequence")
    graph.node("look", "SeesRed", y=400, ports={"column": "output"})
    graph.node("go", "Steer", y=50, ports={"column": "input"})
    for parent, child in (("root", "all"), ("all", "look"), ("all", "go")):
        graph.join(parent, child)
    graph.feed(graph.tag("out", "{column}", writes=True), "look", "column")
    graph.feed(graph.tag("in", "{column}"), "go", "column")
    return _write(folder, graph, {"SeesRed": SEES_RED, "Steer": STEER})


def write_avoider(folder: Path) -> Path:
    """Writes a project that drives to a target among obstacles, with the laser of the F1."""
    graph = Graph()
    graph.node("root", ROOT)
    graph.node("go", "Forces", ports={"x": "input", "y": "input"})
    graph.join("root", "go")
    for port, value in (("x", "0"), ("y", "-30")):
        graph.feed(graph.tag(port, value), "go", port)
    return _write(folder, graph, {"Forces": FORCES})


def write_wanderer(folder: Path, order: str = "bottom-to-top") -> Path:
    """Writes a project that drives with a LIDAR and turns away from obstacles.

    In the other `order` it only drives.
    """
    graph = Graph()
    graph.node("root", ROOT)
    graph.node("all", "ReactiveSequence")
    graph.node("free", "ReactiveFallback", y=300)
    graph.node("not", "Inverter", y=400)
    graph.node("near", "IsNear", ports={"width": "input", "distance": "input"})
    graph.node("turn", "Rotate", y=100, ports={"speed": "input"})
    graph.node("go", "Advance", y=50, ports={"speed": "input"})
    for parent, child in (
        ("root", "all"), ("all", "go"), ("free", "turn"), ("free", "not"), ("not", "near"),
    ):  # fmt: skip
        graph.join(parent, child)
    graph.join("all", "free", backwards=True)
    for tag, value, node, port in (
        ("w", "40", "near", "width"), ("d", "0.9", "near", "distance"),
        ("t", "0.6", "turn", "speed"), ("s", "0.4", "go", "speed"),
    ):  # fmt: skip
        graph.feed(graph.tag(tag, value), node, port)
    return _write(folder, graph, {"IsNear": IS_NEAR, "Advance": ADVANCE, "Rotate": ROTATE}, order)


def write_follower(folder: Path) -> Path:
    """Writes a project that follows a person in green with a camera."""
    graph = Graph()
    graph.node("root", ROOT)
    graph.node("all", "ReactiveSequence")
    graph.node("seen", "ReactiveFallback", y=300)
    graph.node("look", "SeesGreen", y=400, ports={"middle": "output", "height": "output"})
    graph.node("turn", "Rotate", y=100, ports={"speed": "input"})
    graph.node("go", "Approach", y=50, ports={"middle": "input", "height": "input"})
    for parent, child in (
        ("root", "all"),
        ("all", "seen"),
        ("all", "go"),
        ("seen", "turn"),
        ("seen", "look"),
    ):
        graph.join(parent, child)
    graph.feed(graph.tag("t", "0.6"), "turn", "speed")
    for port in ("middle", "height"):
        graph.feed(graph.tag(f"out {port}", f"{{{port}}}", writes=True), "look", port)
        graph.feed(graph.tag(f"in {port}", f"{{{port}}}"), "go", port)
    return _write(folder, graph, {"SeesGreen": SEES_GREEN, "Approach": APPROACH, "Rotate": ROTATE})


def _write(folder: Path, graph: Graph, actions: Mapping[str, str], order: str = "bottom-to-top") -> Path:
    trees, code = folder / "code" / "trees", folder / "code" / "actions"
    trees.mkdir(parents=True)
    code.mkdir()
    (trees / "main.json").write_text(json.dumps(graph.document()))
    settings = {"name": folder.name, "config": {"btOrder": order}}
    (folder / "config.json").write_text(json.dumps(settings))
    for name, text in actions.items():
        (code / f"{name}.py").write_text(text)
    return folder
