"""The navigation of a world as a ROS node: Nav2's actions and services for its first robot.

It is off until a client of one of its names appears, or a subscriber to its map; and it stays off while
another node offers one of them, as a real Nav2 does, or is expected to. It needs no thread and no waiting:
`poll` handles the requests that arrived, and works on the goals for a moment of simulated time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from executor.navigation import tasks
from executor.navigation.forms import MAP_FRAME, FrameError, between, grid_message, path_message, pose_of
from executor.navigation.mapping import map_of, radius_of
from executor.navigation.others import Others
from executor.navigation.planner import Map
from executor.navigation.server import StepServer
from executor.navigation.tasks import Refused, Situation, Task
from executor.ros import messages
from executor.ros.environment import has_tf
from executor.ros.feed import Due
from executor.ros.outlet import Outlet, Piped
from executor.ros.spin import DrainingExecutor
from executor.world.geometry.transforms import from_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.context import Context

    from executor.world.interface import Robot, World

    Begin = Callable[[Any, Situation, Task | None], Task]

STEP_HZ: Final = 20.0
FEEDBACK_HZ: Final = 5.0
LOOK_HZ: Final = 4.0
"""How often it looks for clients while it is off, and for changes of the map while it works."""
ASKED_S: Final = 1.0
"""The simulated time after the end of a goal in which its client has asked for the result."""
MOVED_M: Final = 0.02
ACTIONS: Final[dict[str, tuple[str, Begin]]] = {
    "/navigate_to_pose": ("NavigateToPose", lambda goal, at, _: tasks.Navigate(goal, at)),
    "/navigate_through_poses": ("NavigateThroughPoses", lambda goal, at, _: tasks.Navigate(goal, at)),
    "/compute_path_to_pose": ("ComputePathToPose", lambda goal, at, _: tasks.FindPath(goal, at)),
    "/compute_path_through_poses": ("ComputePathThroughPoses", lambda goal, at, _: tasks.FindPath(goal, at)),
    "/follow_path": ("FollowPath", tasks.FollowPath),
    "/spin": ("Spin", lambda goal, at, _: tasks.spin(goal, at)),
    "/backup": ("BackUp", lambda goal, at, _: tasks.back_up(goal, at)),
    "/drive_on_heading": ("DriveOnHeading", lambda goal, at, _: tasks.drive_on_heading(goal, at)),
    "/wait": ("Wait", lambda goal, at, _: tasks.Pause(goal, at)),
}
CLEARING: Final = {
    "clear_entirely": "ClearEntireCostmap",
    "clear_around": "ClearCostmapAroundRobot",
    "clear_around_pose": "ClearCostmapAroundPose",
    "clear_except": "ClearCostmapExceptRegion",
}
SERVICES: Final[dict[str, str]] = {
    f"/{map_}_costmap/{verb}_{map_}_costmap": kind
    for map_ in ("local", "global")
    for verb, kind in CLEARING.items()
} | {"/is_path_valid": "IsPathValid", "/global_costmap/get_cost_global_costmap": "GetCost"}
MAP_TOPIC: Final = "/map"
_MAP_QOS: Final = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_TF_QOS: Final = QoSProfile(depth=100)


@dataclass
class _Goal:
    """A goal under way."""

    server: StepServer
    handle: Any
    task: Task
    shown: Any = None


class Navigation:
    """Serves Nav2's actions for the first robot of a world, from the truth of the simulation.

    Args:
        world: the world.
        context: the ROS context of the world.
        outlet: the outlet through which map, plan and transforms are published; None publishes directly.
    """

    def __init__(self, world: World, context: Context, *, outlet: Outlet | None = None) -> None:
        self._world = world
        self._outlet = outlet
        self._context = context
        self._node = self._make_node()
        self._names = [f"{name}/_action/send_goal" for name in ACTIONS] + list(SERVICES)
        self._others = Others(self._names, MAP_TOPIC)
        self._step_due, self._look_due, self._feedback_due = Due(STEP_HZ), Due(LOOK_HZ), Due(FEEDBACK_HZ)
        self._executor: DrainingExecutor | None = None
        self._servers: list[StepServer] = []
        self._goals: dict[str, _Goal] = {}
        self._space: Map | None = None
        self._poses: Any = None
        self._radius = 0.0
        self._is_stale = True
        self._ended_s = -ASKED_S

    @property
    def is_on(self) -> bool:
        """Whether it is in use."""
        return self._executor is not None

    def poll(self, *, is_paused: bool = False) -> None:
        """Handles requests and works on the goals, if the simulated time is due; cheap while it is off."""
        now_s = self._world.time_s
        if is_paused:
            if self._executor is not None:
                self._executor.drain()
            elif self._is_wanted():
                self._open()
            return
        if not self._step_due(now_s):
            return
        looks = self._look_due(now_s)
        if self._executor is None:
            if looks and self._is_wanted():
                self._open()
            return
        if looks and self._is_idle(now_s) and self._others.offer(self._node, own=1):
            self._withdraw()
            return
        if looks:
            self._check_map()
        self._executor.drain()
        ended = self._work(gives_feedback=self._feedback_due(now_s))
        if ended:
            self._executor.drain()
        self._publish_frame(now_s)

    def restart(self) -> None:
        """Ends all goals: simulated time starts again."""
        for due in (self._step_due, self._look_due, self._feedback_due):
            due.restart()
        self._is_stale = True
        for name in list(self._goals):
            self._end(name, "UNKNOWN", "the world was reset")
        if self._executor is not None:
            self._executor.drain()

    def expect(self, names: Sequence[str]) -> None:
        """Leaves navigation to nodes that have just been started, while they join the graph."""
        self._others.expect(names)
        if names and self.is_on and not self._goals:
            self._withdraw()

    def close(self) -> None:
        """Leaves the graph."""
        if self._executor is not None:
            self._executor.shutdown()
        for server in self._servers:  # rclpy's node leaves them open
            server.destroy()
        self._node.destroy_node()

    def _is_wanted(self) -> bool:
        """Returns whether someone uses one of the names, and nobody else offers any of them."""
        if not self._world.robots:
            return False
        count = self._node
        is_used = any(count.count_clients(name) for name in self._names)
        if not is_used and not count.count_subscribers(MAP_TOPIC):
            return False
        return not self._others.are_expected(count) and not self._others.offer(count, own=0)

    def _is_idle(self, now_s: float) -> bool:
        """Returns whether no goal is under way, and clients have asked for the result of the last one."""
        return not self._goals and not 0 <= now_s - self._ended_s < ASKED_S

    def _make_node(self) -> Node:
        return Node(
            "navigation",
            context=self._context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )

    def _withdraw(self) -> None:
        """Offers nothing any longer; `poll` looks for clients again."""
        self.close()
        self._servers, self._executor = [], None
        self._node = self._make_node()

    def _open(self) -> None:
        from nav2_msgs import action, srv  # noqa: PLC0415 - built at set-up, may be missing

        self._map = self._publisher(OccupancyGrid, MAP_TOPIC, _MAP_QOS)
        self._plan = self._publisher(Path, "/plan", QoSProfile(depth=1))
        self._tf = None
        if has_tf():
            from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - as above

            self._tf = self._publisher(TFMessage, "/tf", _TF_QOS)
        for name, (kind, _) in ACTIONS.items():
            self._servers.append(StepServer(self._node, getattr(action, kind), name, self._begin))
        for name, kind in SERVICES.items():
            handler = {"IsPathValid": self._validate, "GetCost": self._cost}.get(kind, self._clear)
            self._node.create_service(getattr(srv, kind), name, handler)
        self._executor = DrainingExecutor(context=self._context)
        self._executor.add_node(self._node)
        robot = self._world.robots[0]
        centre = next(
            (thing.pose[:2] for thing in self._world.scene.objects if thing.body == robot.id), [0.0, 0.0]
        )
        self._radius = radius_of(self._world.scene, robot.id, (centre[0], centre[1]))
        self._is_stale = True
        self._space_now()
        self._publish_frame(self._world.time_s)

    def _publisher(self, kind: Any, topic: str, qos: QoSProfile) -> Any:
        publisher = self._node.create_publisher(kind, topic, qos)
        return publisher if self._outlet is None else Piped(publisher, self._outlet)

    def _space_now(self) -> Map:
        if self._space is None or self._is_stale:
            x, y, _ = self._robot().pose
            self._poses = self._still_poses()
            grid = map_of(self._world.scene, around=(x, y), poses=self._world.poses())
            self._space, self._is_stale = Map(grid, self._radius), False
            self._map.publish(grid_message(grid, self._world.time_s))
        return self._space

    def _check_map(self) -> None:
        """Notes whether something has moved, so that the map is made again at its next use."""
        poses, last = self._still_poses(), self._poses
        if last is None or poses.shape != last.shape or np.abs(poses - last).max(initial=0.0) > MOVED_M:
            self._is_stale = True

    def _still_poses(self) -> Any:
        """Returns the poses of everything but robots."""
        is_thing = [thing.kind != "robot" for thing in self._world.scene.objects]
        return np.array(self._world.poses())[is_thing]

    def _clear(self, _request: Any, response: Any) -> Any:
        self._is_stale = True
        return response

    def _validate(self, request: Any, response: Any) -> Any:
        space, at = self._space_now(), self._situation()
        response.invalid_pose_indices = [
            index
            for index, pose in enumerate(request.path.poses)
            if not space.allows(*pose_of(pose, at.pose, at.odometry)[:2])
        ]
        # As in Nav2, an empty path is not valid.
        response.is_valid = bool(request.path.poses) and not response.invalid_pose_indices
        return response

    def _cost(self, request: Any, response: Any) -> Any:
        space = self._space_now()
        response.cost = space.nav2_cost(request.x, request.y, is_footprint=request.use_footprint)
        return response

    def _robot(self) -> Robot:
        return self._world.robots[0]

    def _situation(self) -> Situation:
        robot = self._robot()
        odometry = robot.odometry
        return Situation(
            self._world.time_s,
            robot.pose,
            (odometry.x, odometry.y, odometry.yaw),
            odometry.linear,
            self._space_now,
        )

    def _begin(self, server: StepServer, handle: Any) -> None:
        """Begins the work on a goal. It replaces the last goal of the action, and other goals that move."""
        at = self._situation()
        last = self._goals.get(server.name)
        try:
            task = ACTIONS[server.name][1](handle.request, at, last.task if last else None)
        except FrameError as error:
            task = Refused(at, "TF_ERROR", str(error))
        for name, goal in list(self._goals.items()):
            if goal is last or (task.moves and goal.task.moves):
                self._end(name, "UNKNOWN", "another goal replaces this one")
        self._goals[server.name] = _Goal(server, handle, task)

    def _work(self, *, gives_feedback: bool) -> bool:
        """Works on each goal for a moment; returns whether one ended."""
        before = len(self._goals)
        for name, goal in list(self._goals.items()):
            at, state = self._situation(), goal.task.state
            if goal.handle.is_cancel_requested:
                self._end(name)
                continue
            if not state.is_over:
                goal.task.step(at)
            self._show(goal, at)
            if state.is_over:
                self._end(name, state.error, state.message)
                continue
            if goal.task.moves:
                self._robot().command(state.linear, state.angular)
            if gives_feedback:
                feedback = goal.server.action_type.Feedback()
                goal.task.report(feedback, at)
                goal.handle.publish_feedback(feedback)
        return len(self._goals) < before

    def _end(self, name: str, error: str = "", message: str = "") -> None:
        goal = self._goals.pop(name)
        self._ended_s = self._world.time_s
        result = goal.server.action_type.Result()
        goal.task.answer(result, self._situation())
        if hasattr(result, "error_code"):
            result.error_code, result.error_msg = code_of(type(result), error), message
        goal.server.end(goal.handle, result, reached=not error)
        if goal.task.moves:
            self._robot().stop()

    def _show(self, goal: _Goal, at: Situation) -> None:
        """Publishes the path of a goal when it changes."""
        points, yaw = goal.task.plan()
        if len(points) and points is not goal.shown:
            goal.shown = points
            self._plan.publish(path_message(points, yaw, at.now_s))

    def _publish_frame(self, now_s: float) -> None:
        """Publishes where the odometry's frame is in the map."""
        if self._tf is None:
            return
        at = self._situation()
        x, y, yaw = between(at.pose, at.odometry)
        pose = from_xyz_rpy((x, y, 0.0, 0.0, 0.0, yaw))
        self._tf.publish(
            messages.transforms([messages.transform(MAP_FRAME, messages.ODOM_FRAME, pose, now_s)])
        )


def code_of(result: Any, error: str) -> int:
    """Returns Nav2's error code of an error; an action without codes of its own has those of its parts."""
    if not error:
        return 0
    from nav2_msgs.action import ComputePathToPose, FollowPath  # noqa: PLC0415 - may be missing

    for each in (result, ComputePathToPose.Result, FollowPath.Result):
        if hasattr(each, error):
            return int(getattr(each, error))
    return int(ComputePathToPose.Result.UNKNOWN)
