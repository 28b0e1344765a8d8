"""Drives a robot through the world *House* with one tree of Nav2, and says how it ended and why.

The tree is called from one that sets `goal` and `goals`, as a user of Nav2's trees does. As a program it
reads a tree as JSON, and its last line is the row.
"""

from __future__ import annotations

import json
import math
import re
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from translator import open_files
from translator.importer import from_xml
from translator.nav2.change import changed

if TYPE_CHECKING:
    from collections.abc import Iterable

    from executor.headless.report import NodeCount, Report
    from executor.world.interface import World
    from translator import Project
    from translator.nav2.distributions import Distribution
    from tree_gardener import Tree
    from tree_gardener.node import Node

UNIVERSE: Final = "house"
GOAL: Final = (4.9, -1.5)
"""In the kitchen."""
VIA: Final = (2.0, 0.0)
OPEN_PLACE: Final = (-2.8, -3.05)
"""In the living room, where a tree that has no goal has room to drive."""
TOLERANCE_M: Final = 0.3
DURATION_S: Final = 240.0
TICK_HZ: Final = 20.0
SERVERS: Final = {
    "assisted_teleop": "a behaviour server with assisted teleoperation",
    "compute_and_track_route": "a route server, with a graph of routes",
    "compute_route": "a route server, with a graph of routes",
    "dock_robot": "a docking server",
    "follow_object": "a following server",
    "smooth_path": "a smoother server",
    "undock_robot": "a docking server",
}
STATUSES: Final = """from dataclasses import dataclass
from typing import Any, ClassVar

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.poses import poses_from
from tree_gardener.ports import Port, get_input, set_output


@dataclass
class WaypointStatus:
    PENDING: ClassVar = 0
    COMPLETED: ClassVar = 1
    SKIPPED: ClassVar = 2
    waypoint_pose: Any
    waypoint_status: int = 0

    def get_fields_and_field_types(self):
        return ("waypoint_pose", "waypoint_status")


class PendingWaypoints(Behaviour):
    INPUT_PORTS = {"goals": Port()}
    OUTPUT_PORTS = {"statuses": Port()}

    def update(self):
        poses = poses_from(get_input(self, "goals"))
        set_output(self, "statuses", [WaypointStatus(pose) for pose in poses])
        return Status.SUCCESS
"""
"""Stands in for the navigator, which since Kilted sets the statuses of its waypoints.

Jazzy's nav2_msgs, with which sessions run, has no such message.
"""
_MAIN: Final = re.compile(r'main_tree_to_execute="([^"]+)"')
_FIRST: Final = re.compile(r'<BehaviorTree ID="([^"]+)"')


@dataclass(frozen=True)
class Shipped:
    """A tree that Nav2 ships for a distribution."""

    distribution: Distribution
    name: str
    xml: str

    @property
    def has_goal(self) -> bool:
        """Whether the tree reads a goal; otherwise it is to end where it begins."""
        return "{goal}" in self.xml or "{goals}" in self.xml


class Row(NamedTuple):
    """The result of a tree: `outcome` is `arrived` or how it ended, `reason` says what it lacks to arrive."""

    distribution: str
    tree: str
    outcome: str
    plans: int
    reason: str


def project_of(shipped: Shipped) -> Project:
    """Returns a project for the tree's distribution whose main tree calls it.

    Raises:
        ValueError: the distribution lacks a node or a port of the tree.
    """
    found = _MAIN.search(shipped.xml) or _FIRST.search(shipped.xml)
    tree_id = found[1] if found is not None else ""
    x, y = GOAL
    goals = f"goal := '{x};{y};0'; goals := '{VIA[0]};{VIA[1]};0|{x};{y};0'"
    way = "" if shipped.has_goal else f'<NavigateToPose goal="{OPEN_PLACE[0]};{OPEN_PLACE[1]};0"/>'
    actions = {}
    if "{waypoint_statuses}" in shipped.xml:
        actions["PendingWaypoints.py"] = STATUSES.encode()
        way += '<PendingWaypoints goals="{goals}" statuses="{waypoint_statuses}"/>'
    house = (
        '<root BTCPP_format="4" main_tree_to_execute="House"><include path="tree.xml"/>'
        f'<BehaviorTree ID="House"><Sequence><Script code="{goals}"/>{way}'
        f'<SubTree ID="{tree_id}" _autoremap="true"/></Sequence></BehaviorTree></root>'
    )
    included = {"tree.xml": shipped.xml.encode()}
    files = dict(from_xml(house, file="house.xml", included=included, actions=actions).files)
    change = changed(files, shipped.distribution)
    if change.lacks:
        raise ValueError(f"{shipped.distribution}, {shipped.name}: {', '.join(map(str, change.lacks))}")
    files.update({path: raw for path, raw in change.files.items() if raw is not None})
    return open_files({path: raw for path, raw in files.items() if change.files.get(path, raw) is not None})


class _Watch:
    """Keeps the tree, and where the robot was when the tree of Nav2 began."""

    def __init__(self) -> None:
        self.tree: Tree | None = None
        self.began: tuple[float, float] | None = None

    def __call__(self, world: World, tree: Tree) -> None:
        self.tree = tree
        called = next(node for node in tree.nodes if node.type == "SubTree")
        if self.began is None and called.status.name == "RUNNING":
            x, y, _ = world.robots[0].pose
            self.began = (x, y)


def drive(shipped: Shipped) -> Row:
    """Runs a tree in lock-step, and returns its row."""
    from executor.headless.lockstep import LockstepOptions, run_lockstep

    watch = _Watch()
    options = LockstepOptions(universe=UNIVERSE, duration_s=DURATION_S, tick_hz=TICK_HZ)
    report = run_lockstep(project_of(shipped), options, watch=watch, say=lambda _: None)
    _, x, y, *_ = report.trajectory[-1]
    goal = GOAL if shipped.has_goal else watch.began or GOAL
    left_m = math.dist((x, y), goal)
    nodes = list(zip(watch.tree.nodes if watch.tree is not None else (), report.nodes, strict=True))
    plans = sum(count.success for node, count in nodes if node.type.startswith("ComputePath"))
    outcome = outcome_of(report.root_status, left_m)
    reason = "" if outcome == "arrived" else reason_of(report, nodes, left_m)
    return Row(shipped.distribution, shipped.name, outcome, plans, reason)


def outcome_of(status: str, left_m: float) -> str:
    """Returns `arrived` if the tree succeeded and the robot is near its goal, else how it ended."""
    if status == "SUCCESS" and left_m <= TOLERANCE_M:
        return "arrived"
    return f"{status}, {left_m:.1f} m from the goal"


def reason_of(report: Report, nodes: Iterable[tuple[Node, NodeCount]], left_m: float) -> str:
    """Returns what a tree needs to arrive: a server that is not here, a client, or what a node said."""
    nodes = list(nodes)
    for node, count in nodes:
        name = _missing(node)
        if name and count.failure and not count.success:
            return f"{SERVERS.get(name, 'a server')}: nobody serves `/{name}` here"
    if report.root_status == "RUNNING" and any(node.type == "KeepRunningUntilFailure" for node, _ in nodes):
        return f"a client that cancels: the tree follows its point without an end, {left_m:.1f} m behind it"
    if report.errors:
        return str(report.errors[0]["message"])
    if report.root_status == "SUCCESS":
        return "a node that drives: the tree ends before its goal"
    failed = [node.type for node, count in nodes if count.failure and not node.children]
    return f"what {failed[-1]} asks for" if failed else "more time"


def _missing(node: Node) -> str:
    """Returns the action of a node that the house does not serve, or ""."""
    from executor.navigation.node import ACTIONS

    action: Any = getattr(getattr(node, "behaviour", None), "ACTION_NAME", "")
    return str(action) if action and f"/{action}" not in ACTIONS else ""


if __name__ == "__main__":
    print(json.dumps(drive(Shipped(**json.load(sys.stdin)))))
