"""Goals of Nav2's actions as tasks: each reads its goal, works in steps, and fills result and feedback."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Final, NamedTuple, Protocol

from executor.navigation.forms import duration, path_message, pose_of, seconds_of, stamped
from executor.navigation.jobs import Following, Navigating, Planning, State
from executor.navigation.motions import Drive, Spin, Wait

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from executor.navigation.motions import Motion
    from executor.navigation.planner import Map
    from executor.navigation.pursuit import Point, Pose

CELLS: Final = 1500
"""The cells that a search expands in one step: about 10 ms."""
PASSED_M: Final = 0.5
SLOW_M_S: Final = 0.1
_MOTION_ERRORS: Final = {"timeout": "TIMEOUT", "collision": "COLLISION_AHEAD"}
_MOTION_TEXTS: Final = {
    "timeout": "the motion was not finished within its time allowance",
    "collision": "something stands in the way",
}


class Situation(NamedTuple):
    """The robot at one time, and its surroundings."""

    now_s: float
    pose: Pose
    odometry: Pose
    speed: float
    space: Callable[[], Map]

    def pose_of(self, message: Any) -> Pose:
        """Returns a stamped pose in the map."""
        return pose_of(message, self.pose, self.odometry)


class Task(Protocol):
    """The work on one goal. `moves` says whether it commands the robot."""

    moves: ClassVar[bool]
    state: State

    def step(self, at: Situation) -> None:
        """Works for a moment; afterwards `state` holds the command, or the end."""

    def answer(self, result: Any, at: Situation) -> None:
        """Fills the result, except for error code and message."""

    def report(self, feedback: Any, at: Situation) -> None:
        """Fills the feedback."""

    def plan(self) -> tuple[Sequence[Point], float | None]:
        """Returns the path that is to be shown and its last heading; an empty path if there is none."""


class _Task:
    moves: ClassVar[bool] = False

    def __init__(self, at: Situation) -> None:
        self.began_s = at.now_s
        self.state = State()

    def step(self, at: Situation) -> None:
        """Does nothing."""

    def answer(self, result: Any, at: Situation) -> None:
        """Writes the time that it took, if the result has a place for it."""
        for name in ("total_elapsed_time", "planning_time"):
            if hasattr(result, name):
                setattr(result, name, duration(at.now_s - self.began_s))

    def report(self, feedback: Any, at: Situation) -> None:
        """Writes nothing."""

    def plan(self) -> tuple[Sequence[Point], float | None]:
        return (), None


class FindPath(_Task):
    """ComputePathToPose and ComputePathThroughPoses."""

    def __init__(self, request: Any, at: Situation) -> None:
        super().__init__(at)
        wanted = request.goals if hasattr(request, "goals") else [request.goal]
        goals = [at.pose_of(each) for each in getattr(wanted, "goals", wanted)]
        start = at.pose_of(request.start) if request.use_start else at.pose
        self._yaw = goals[-1][2] if goals else None
        self._planning = Planning(at.space(), start, goals)
        self.state = self._planning.state
        if not goals and hasattr(request, "goals"):
            self.state.error = "NO_VIAPOINTS_GIVEN"

    def step(self, at: Situation) -> None:
        self._planning.step(CELLS)

    def answer(self, result: Any, at: Situation) -> None:
        super().answer(result, at)
        if not self.state.error:
            result.path = path_message(self._planning.points, self._yaw, at.now_s)

    def plan(self) -> tuple[Sequence[Point], float | None]:
        return (
            (self._planning.points, self._yaw) if self.state.is_over and not self.state.error else ((), None)
        )


class FollowPath(_Task):
    """FollowPath. A goal that replaces another one continues with its speed and its time without progress."""

    moves = True

    def __init__(self, request: Any, at: Situation, last: Task | None = None) -> None:
        super().__init__(at)
        poses = [
            at.pose_of(each) if each.header.frame_id else at.pose_of(_in(each, request.path))
            for each in request.path.poses
        ]
        points, yaw = [pose[:2] for pose in poses], poses[-1][2] if poses else None
        if isinstance(last, FollowPath) and points and not last.state.is_over:
            self._following: Following = last._following
            self._following.change(points, yaw)
        else:
            self._following = Following(points, yaw, at.now_s, at.pose)
        self.state = self._following.state

    def step(self, at: Situation) -> None:
        self._following.step(at.now_s, at.pose, at.speed, at.space())

    def report(self, feedback: Any, at: Situation) -> None:
        feedback.distance_to_goal, feedback.speed = float(self._following.left()), float(at.speed)


class Navigate(_Task):
    """NavigateToPose and NavigateThroughPoses."""

    moves = True

    def __init__(self, request: Any, at: Situation) -> None:
        super().__init__(at)
        wanted = request.poses if hasattr(request, "poses") else [request.pose]
        self._goals = [at.pose_of(each) for each in getattr(wanted, "goals", wanted)]
        self._left = list(self._goals)
        self._job = Navigating(at.space, self._left, at.now_s)
        self.state = self._job.state

    def step(self, at: Situation) -> None:
        # A pose that was reached is left out of the next plan.
        while len(self._left) > 1 and math.dist(at.pose[:2], self._left[0][:2]) < PASSED_M:
            del self._left[0]
        self._job.step(at.now_s, at.pose, at.speed, CELLS)

    def report(self, feedback: Any, at: Situation) -> None:
        left = self._job.left()
        feedback.current_pose = stamped(at.pose, at.now_s)
        feedback.navigation_time = duration(at.now_s - self.began_s)
        feedback.estimated_time_remaining = duration(left / max(at.speed, SLOW_M_S) if left else 0.0)
        feedback.number_of_recoveries = self._job.recoveries
        feedback.distance_remaining = left
        if hasattr(feedback, "number_of_poses_remaining"):
            feedback.number_of_poses_remaining = len(self._left)

    def plan(self) -> tuple[Sequence[Point], float | None]:
        return self._job.path, self._goals[-1][2] if self._goals else None


class Move(_Task):
    """Spin, BackUp and DriveOnHeading."""

    moves = True

    def __init__(self, request: Any, at: Situation, motion: Motion) -> None:
        super().__init__(at)
        self._motion = motion
        self._covered = 0.0

    def step(self, at: Situation) -> None:
        step = self._motion.step(at.now_s, at.pose)
        self._covered = step.covered
        self.state.linear, self.state.angular = step.linear, step.angular
        if step.is_over:
            self.state.end(_MOTION_ERRORS.get(step.error, step.error), _MOTION_TEXTS.get(step.error, ""))

    def report(self, feedback: Any, at: Situation) -> None:
        name = (
            "angular_distance_traveled"
            if hasattr(feedback, "angular_distance_traveled")
            else "distance_traveled"
        )
        setattr(feedback, name, self._covered)


class Pause(_Task):
    """Wait."""

    def __init__(self, request: Any, at: Situation) -> None:
        super().__init__(at)
        self._duration_s = seconds_of(request.time)
        self._wait = Wait(self._duration_s, at.now_s)

    def step(self, at: Situation) -> None:
        if self._wait.step(at.now_s, at.pose).is_over:
            self.state.end()

    def report(self, feedback: Any, at: Situation) -> None:
        feedback.time_left = duration(max(0.0, self._duration_s - (at.now_s - self.began_s)))


class Refused(_Task):
    """A goal that cannot be worked on."""

    def __init__(self, at: Situation, error: str, message: str) -> None:
        super().__init__(at)
        self.state.end(error, message)


def spin(request: Any, at: Situation) -> Task:
    """Returns the task of a Spin."""
    allowance_s = seconds_of(request.time_allowance)
    return Move(request, at, Spin(request.target_yaw, allowance_s, at.now_s, at.pose))


def back_up(request: Any, at: Situation) -> Task:
    """Returns the task of a BackUp, whose target and speed may be given with either sign."""
    return _drive(request, at, -abs(request.speed))


def drive_on_heading(request: Any, at: Situation) -> Task:
    """Returns the task of a DriveOnHeading; target and speed have the same sign."""
    if request.target.x * request.speed < 0:
        return Refused(at, "INVALID_INPUT", "the distance and the speed differ in their signs")
    return _drive(request, at, request.speed)


def _drive(request: Any, at: Situation, speed: float) -> Task:
    if request.target.y or request.target.z:
        return Refused(at, "INVALID_INPUT", "the robot drives along its x axis only; y and z must be 0")
    if not speed:
        return Refused(at, "INVALID_INPUT", "the speed is 0")
    allowance_s = seconds_of(request.time_allowance)
    motion = Drive(
        request.target.x,
        speed,
        allowance_s,
        at.now_s,
        pose=at.pose,
        allows=lambda x, y: at.space().allows(x, y),
    )
    return Move(request, at, motion)


def _in(pose: Any, path: Any) -> Any:
    """Returns a pose without a frame in the frame of its path."""
    pose.header.frame_id = path.header.frame_id
    return pose
