"""The jobs of the navigation: to find a path, to follow one, to visit poses, each in small steps."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from executor.navigation import pursuit
from executor.navigation.motions import Drive, Spin, Wait
from executor.navigation.planner import Map, Search, smoothed

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from executor.navigation.motions import Motion
    from executor.navigation.pursuit import Point, Pose

    Space = Callable[[], Map]

NEAR_M: Final = 0.5
"""A start or goal that is occupied is replaced by the nearest free place, if that is as near as this."""
GOAL_M: Final = 0.2
GOAL_RAD: Final = 0.2
PROGRESS_M: Final = 0.3
PROGRESS_S: Final = 10.0
PATIENCE_S: Final = 2.0
LOOK_M: Final = 0.8
REPLAN_S: Final = 2.0
MOST_RECOVERIES: Final = 6


@dataclass
class State:
    """The state of a job. `error` is a name of Nav2's error codes; an empty one at the end is success."""

    is_over: bool = False
    error: str = ""
    message: str = ""
    linear: float = 0.0
    angular: float = 0.0

    def end(self, error: str = "", message: str = "") -> State:
        """Ends the job; the robot stops."""
        self.is_over, self.error, self.message = True, error, message
        self.linear = self.angular = 0.0
        return self


class Planning:
    """Searches a path from a pose to a goal, over any number of poses between."""

    def __init__(self, space: Map, start: Pose, goals: Sequence[Pose]) -> None:
        self._space = space
        self._stops = [start, *goals]
        self._at = 0
        self._search: Search | None = None
        self.points: list[Point] = []
        self.state = State()
        if not goals:
            self.state.end("NO_VALID_PATH", "there is no goal")

    def step(self, count: int) -> State:
        """Expands at most `count` cells."""
        if self.state.is_over:
            return self.state
        if self._search is None and not self._begin():
            return self.state
        search = self._search
        assert search is not None  # noqa: S101 - made by `_begin`
        if not search.expand(count):
            return self.state
        if search.path is None:
            x, y, _ = self._stops[self._at + 1]
            return self.state.end("NO_VALID_PATH", f"no path leads to ({x:.2f}, {y:.2f})")
        self._add(search)
        self._at += 1
        self._search = None
        if self._at + 1 == len(self._stops):
            self.state.end()
        return self.state

    def _begin(self) -> bool:
        names = ("START_OUTSIDE_MAP", "START_OCCUPIED"), ("GOAL_OUTSIDE_MAP", "GOAL_OCCUPIED")
        cells = []
        for (outside, occupied), (x, y, _) in zip(names, self._stops[self._at : self._at + 2], strict=True):
            cell = self._space.grid.cell(x, y)
            if cell is None:
                self.state.end(outside, f"({x:.2f}, {y:.2f}) is outside of the map")
                return False
            free = self._space.nearest_free(cell, NEAR_M)
            if free is None:
                self.state.end(occupied, f"something stands at ({x:.2f}, {y:.2f})")
                return False
            cells.append(free)
        self._search = Search(self._space, cells[0], cells[1])
        return True

    def _add(self, search: Search) -> None:
        grid = self._space.grid
        points = [grid.point(cell) for cell in search.path or ()]
        x, y, _ = self._stops[self._at + 1]
        if self._space.allows(x, y):
            points.append((x, y))
        self.points += smoothed(points, self._space)


class Following:
    """Follows a path until its end, and turns to the final heading."""

    def __init__(self, path: Sequence[Point], yaw: float | None, now_s: float, pose: Pose) -> None:
        self.path = list(path)
        self._yaw = yaw
        self._index = 0
        self._mark, self._mark_s = pose, now_s
        self._free_s = now_s
        self._is_turning = False
        self.state = State()
        if not path:
            self.state.end("INVALID_PATH", "the path is empty")

    def change(self, path: Sequence[Point], yaw: float | None = None) -> None:
        """Follows another path from now on; the time without progress continues to count."""
        self.path, self._index, self._is_turning = list(path), 0, False
        self._yaw = self._yaw if yaw is None else yaw

    def left(self) -> float:
        """Returns the length of the rest of the path."""
        return pursuit.remaining(self.path, self._index)

    def step(self, now_s: float, pose: Pose, speed: float, space: Map) -> State:
        """Sets the next command."""
        state = self.state
        if state.is_over:
            return state
        self._index = pursuit.nearest(self.path[: self._index + 40], pose, self._index)
        near = math.dist(pose[:2], self.path[-1]) < GOAL_M and self.left() < 2 * GOAL_M
        self._is_turning = self._is_turning or near
        if self._is_turning:
            if self._yaw is None or abs(pursuit.wrapped(self._yaw - pose[2])) < GOAL_RAD:
                return state.end()
            state.linear, state.angular = 0.0, pursuit.turn_to(self._yaw, pose)
            return state
        if not self._has_progress(now_s, pose):
            return state.end("FAILED_TO_MAKE_PROGRESS", "the robot does not come nearer")
        clearance = space.clearance_at(pose[0], pose[1]) - space.radius
        state.linear, state.angular = pursuit.command(self.path, pose, speed, clearance, index=self._index)
        if self._is_blocked(pose, space):
            state.linear = state.angular = 0.0
            if now_s - self._free_s > PATIENCE_S:
                return state.end("NO_VALID_CONTROL", "something stands in the way")
        else:
            self._free_s = now_s
        return state

    def _has_progress(self, now_s: float, pose: Pose) -> bool:
        turned = abs(pursuit.wrapped(pose[2] - self._mark[2])) > 0.5
        if turned or math.dist(pose[:2], self._mark[:2]) > PROGRESS_M:
            self._mark, self._mark_s = pose, now_s
        return now_s - self._mark_s < PROGRESS_S

    def _is_blocked(self, pose: Pose, space: Map) -> bool:
        """Returns whether the next part of the path is occupied; a robot in a tight place may leave it."""
        near = [p for p in self.path[self._index :][:40] if math.dist(p, pose[:2]) < LOOK_M]
        return space.allows(pose[0], pose[1]) and not all(space.allows(x, y) for x, y in near)


@dataclass
class Navigating:
    """Visits poses: plans, follows, plans again, and recovers where that fails."""

    space: Space
    goals: list[Pose]
    began_s: float
    state: State = field(default_factory=State)
    recoveries: int = 0
    _planning: Planning | None = None
    _following: Following | None = None
    _motion: Motion | None = None
    _planned_s: float = -math.inf

    def left(self) -> float:
        """Returns the length of the path that is left."""
        return self._following.left() if self._following else 0.0

    @property
    def path(self) -> list[Point]:
        """The path that is followed; empty if there is none."""
        return self._following.path if self._following else []

    def step(self, now_s: float, pose: Pose, speed: float, count: int) -> State:
        """Sets the next command; a search expands at most `count` cells."""
        state = self.state
        if state.is_over:
            return state
        if self._motion is not None:
            step = self._motion.step(now_s, pose)
            state.linear, state.angular = step.linear, step.angular
            if step.is_over:
                self._motion = None
                state.linear = state.angular = 0.0
            return state
        if self._planning is None and now_s - self._planned_s >= REPLAN_S:
            self._planned_s = now_s
            self._planning = Planning(self.space(), pose, self.goals)
        if self._planning is not None and self._planning.step(count).is_over:
            planning, self._planning = self._planning, None
            if planning.state.error:
                return self._recover(now_s, pose, planning.state)
            if self._following is None:
                self._following = Following(planning.points, self.goals[-1][2], now_s, pose)
            else:
                self._following.change(planning.points)
        if self._following is None:
            state.linear = state.angular = 0.0
            return state
        followed = self._following.step(now_s, pose, speed, self.space())
        state.linear, state.angular = followed.linear, followed.angular
        if followed.is_over:
            return self._recover(now_s, pose, followed) if followed.error else state.end()
        return state

    def _recover(self, now_s: float, pose: Pose, failed: State) -> State:
        """Begins the next recovery: a wait, a turn, a way back; gives up after the last one."""
        self._following = self._planning = None
        self._planned_s = -math.inf
        self.state.linear = self.state.angular = 0.0
        if self.recoveries >= MOST_RECOVERIES:
            return self.state.end(failed.error, failed.message)
        kind = self.recoveries % 3
        self.recoveries += 1
        if kind == 0:
            self._motion = Wait(3.0, now_s)
        elif kind == 1:
            self._motion = Spin(math.pi / 2, 10.0, now_s, pose)
        else:
            self._motion = Drive(0.3, -0.1, 10.0, now_s, pose=pose, allows=self.space().allows)
        return self.state
