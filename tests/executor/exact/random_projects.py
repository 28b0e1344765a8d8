"""Random projects for exact runs: trees of actions that hold state between ticks, in random worlds.

The action *Witness* writes a hash of all that it hears to the blackboard in each tick, so the fingerprint of
a tick also depends on the bytes of `/scan`, `/odom`, `/cmd_vel`, and of pictures.
"""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from translator import load, to_app_zip

if TYPE_CHECKING:
    import random

UNIVERSES: Final = ("walled_room", "warehouse", "crowd", "random_obstacles", "narrow_passages", "football")
ROBOTS: Final = ("turtle2", "burger", "rover")
SHARE_OF_CAMERAS: Final = 0.15
MOST_DEPTH: Final = 4

HEAD: Final = """
import random
from hashlib import blake2b

import py_trees
from py_trees.common import Status

from tree_gardener.ports import Port, get_input, set_output
"""
ACTIONS: Final = {
    "Witness": """
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image, LaserScan


class Witness(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"pictures": Port(bool, default=False)}
    OUTPUT_PORTS = {"hash": Port(str)}

    def setup(self, **kwargs):
        self.digest = blake2b(digest_size=8)
        node = kwargs["node"]
        kinds = [(LaserScan, "/scan"), (Odometry, "/odom"), (Twist, "/cmd_vel")]
        if get_input(self, "pictures"):
            kinds.append((Image, "/camera/image_raw"))
        for kind, topic in kinds:
            node.create_subscription(kind, topic, self.digest.update, 10, raw=True)

    def update(self):
        set_output(self, "hash", self.digest.hexdigest())
        return Status.RUNNING
""",
    "Drive": """
from geometry_msgs.msg import Twist


class Drive(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"speed": Port(float, default=0.2)}

    def setup(self, **kwargs):
        self.publisher = kwargs["node"].create_publisher(Twist, "/cmd_vel", 10)
        self.drawn = random.Random(random.random())

    def initialise(self):
        self.left = self.drawn.randrange(2, 20)
        print("drives for", self.left)

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        twist.angular.z = self.drawn.uniform(-0.8, 0.8)
        self.publisher.publish(twist)
        self.left -= 1
        return Status.RUNNING if self.left > 0 else Status.SUCCESS
""",
    "Late": """
from geometry_msgs.msg import Twist


class Late(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.count = 0

    def initialise(self):
        self.publisher = self.node.create_publisher(Twist, "/cmd_vel", 10)
        self.timer = self.node.create_timer(0.13, self.on_timer)
        self.begin = self.count

    def on_timer(self):
        self.count += 1
        twist = Twist()
        twist.linear.x = 0.1 * (self.count % 3)
        self.publisher.publish(twist)

    def update(self):
        return Status.SUCCESS if self.count >= self.begin + 4 else Status.RUNNING

    def terminate(self, new_status):
        self.node.destroy_timer(self.timer)
        self.node.destroy_publisher(self.publisher)
""",
    "Ask": """
from std_srvs.srv import Trigger


class Ask(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"service": Port(str, default="/ask")}
    OUTPUT_PORTS = {"answer": Port(str)}

    def setup(self, **kwargs):
        node = kwargs["node"]
        self.asked = 0
        self.server = node.create_service(Trigger, get_input(self, "service"), self.answer)
        self.client = node.create_client(Trigger, get_input(self, "service"))

    def answer(self, request, response):
        self.asked += 1
        response.success = random.random() < 0.7
        response.message = f"{self.asked} {random.random()}"
        return response

    def initialise(self):
        self.future = self.client.call_async(Trigger.Request())

    def update(self):
        if not self.future.done():
            return Status.RUNNING
        set_output(self, "answer", self.future.result().message)
        return Status.SUCCESS if self.future.result().success else Status.FAILURE
""",
    "Walk": """
import numpy as np


class Walk(py_trees.behaviour.Behaviour):
    OUTPUT_PORTS = {"place": Port(str)}

    def setup(self, **kwargs):
        self.place = np.zeros(3)

    def update(self):
        self.place += np.random.default_rng(int(np.random.randint(1 << 30))).normal(size=3)
        set_output(self, "place", " ".join(map(str, self.place)))
        return (Status.RUNNING, Status.SUCCESS, Status.FAILURE)[int(np.random.randint(3))]
""",
    "Fetch": """
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer


class Fetch(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"server": Port(str, default="/fetch")}
    OUTPUT_PORTS = {"sequence": Port(str)}

    def setup(self, **kwargs):
        node, name = kwargs["node"], get_input(self, "server")
        self.server = ActionServer(node, Fibonacci, name, self.execute)
        self.client = ActionClient(node, Fibonacci, name)

    def execute(self, goal):
        goal.succeed()
        result = Fibonacci.Result()
        result.sequence = [0, 1, *(random.randrange(100) for _ in range(goal.request.order))]
        return result

    def initialise(self):
        self.handle = self.result = None
        self.sent = self.client.send_goal_async(Fibonacci.Goal(order=random.randrange(1, 6)))

    def update(self):
        if self.handle is None and self.sent.done():
            self.handle = self.sent.result()
            self.result = self.handle.get_result_async()
        if self.result is None or not self.result.done():
            return Status.RUNNING
        set_output(self, "sequence", str(list(self.result.result().result.sequence)))
        return Status.SUCCESS
""",
}


@dataclass(frozen=True)
class RandomProject:
    """A project, and the world in which it runs."""

    app: str = field(repr=False)
    universe: str
    robot: str
    has_camera: bool
    types: frozenset[str]
    """The types of its blocks."""


def random_project(chance: random.Random) -> RandomProject:
    """Returns a project that never ends by itself; most of its blocks are RUNNING over many ticks."""
    has_camera = chance.random() < SHARE_OF_CAMERAS
    tree = _RandomTree(chance)
    body = tree.node("KeepRunningUntilFailure", tree.node("ForceSuccess", tree.body(0)))
    pictures = {"pictures": str(has_camera).lower(), "hash": "{hash}"}
    root = tree.node(
        "Parallel",
        tree.node("Witness", **pictures),
        body,
        success_count="2",
        failure_count="2",
    )
    diagram = {
        "format": "bt-studio/diagram",
        "version": 1,
        "id": "MainTree",
        "root": root,
        "nodes": tree.nodes,
        "drafts": [],
        "layout": "vertical",
    }
    project = {
        "format": "bt-studio/project",
        "version": 1,
        "name": "Random",
        "main_tree": "MainTree",
        "tick_hz": 20,
        "universe": "walled_room",
        "on_finish": "repeat",
        "on_error": "stop",
    }
    types = frozenset(node["type"] for node in tree.nodes.values())
    files = {"project.json": json.dumps(project), "trees/MainTree.json": json.dumps(diagram)}
    files |= {f"actions/{name}.py": HEAD + ACTIONS[name] for name in ACTIONS.keys() & types}
    data = {name: text.encode() for name, text in files.items()}
    return RandomProject(
        base64.b64encode(to_app_zip(load(data))).decode(),
        chance.choice(UNIVERSES),
        "turtle2" if has_camera else chance.choice(ROBOTS),
        has_camera,
        types,
    )


class _RandomTree:
    """Draws the blocks of a tree below each other."""

    def __init__(self, chance: random.Random) -> None:
        self.nodes: dict[str, dict[str, Any]] = {}
        self._chance = chance

    def node(self, type_: str, *children: str, **ports: str) -> str:
        """Adds a block, and returns its id."""
        id_ = f"n{len(self.nodes) + 1}"
        self.nodes[id_] = {"type": type_}
        if children:
            self.nodes[id_]["children"] = list(children)
        if ports:
            self.nodes[id_]["ports"] = ports
        return id_

    def body(self, depth: int) -> str:
        """Adds a random tree, and returns the id of its root."""
        chance = self._chance
        if depth == 0 or (depth < MOST_DEPTH and chance.random() < 0.5):
            children = [self.body(depth + 1) for _ in range(chance.randrange(2, 4))]
            if chance.random() < 0.25:
                some = str(chance.randrange(1, len(children) + 1))
                return self.node("Parallel", *children, success_count=some, failure_count=some)
            return self.node(chance.choice(["Sequence", "Fallback", "SequenceWithMemory"]), *children)
        if depth < MOST_DEPTH and chance.random() < 0.6:
            return self._decorated(self.body(depth + 1))
        return self._leaf()

    def _decorated(self, child: str) -> str:
        chance = self._chance
        match chance.randrange(5):
            case 0:
                return self.node("Delay", child, delay_msec=str(chance.randrange(50, 600)))
            case 1:
                return self.node("Timeout", child, msec=str(chance.randrange(100, 900)))
            case 2:
                return self.node("Inverter", child)
            case 3:
                return self.node("Repeat", child, num_cycles=str(chance.randrange(2, 4)))
            case _:
                return self.node("RetryUntilSuccessful", child, num_attempts=str(chance.randrange(2, 4)))

    def _leaf(self) -> str:
        chance, number = self._chance, len(self.nodes) + 1
        match chance.choice(["Drive", "Drive", "Late", "Ask", "Walk", "Fetch", "Sleep"]):
            case "Drive":
                return self.node("Drive", speed=str(round(chance.uniform(-0.1, 0.4), 2)))
            case "Ask":
                return self.node("Ask", service=f"/ask_{number}", answer=f"{{answer_{number}}}")
            case "Walk":
                return self.node("Walk", place=f"{{place_{number}}}")
            case "Fetch":
                return self.node("Fetch", server=f"/fetch_{number}", sequence=f"{{sequence_{number}}}")
            case "Late":
                return self.node("Late")
            case _:
                return self.node("Sleep", msec=str(chance.randrange(50, 500)))
