"""The recoveries and other motions without a path: spin, drive on a heading, wait.

Each is asked for its next command with the time and the robot's pose, until it is over.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Protocol

from executor.navigation.pursuit import Pose, wrapped

if TYPE_CHECKING:
    from collections.abc import Callable

    Allows = Callable[[float, float], bool]

TURN_MIN: Final = 0.15
TURN_MAX: Final = 1.0
LOOK_AHEAD_S: Final = 0.6


@dataclass(frozen=True)
class Step:
    """The command of a motion in m/s and rad/s, the covered distance, and the way in which it ended."""

    linear: float = 0.0
    angular: float = 0.0
    covered: float = 0.0
    is_over: bool = False
    error: str = ""
    """Empty, `timeout` or `collision`."""


class Motion(Protocol):
    """A motion."""

    def step(self, now_s: float, pose: Pose) -> Step:
        """Returns the next command."""


class Wait:
    """Pauses for a time."""

    def __init__(self, duration_s: float, now_s: float) -> None:
        self._began_s, self._duration_s = now_s, duration_s

    def step(self, now_s: float, pose: Pose) -> Step:
        """Returns how long it has waited."""
        waited = now_s - self._began_s
        return Step(covered=waited, is_over=waited >= self._duration_s)


class Spin:
    """Turns on the spot by an angle, which may be more than a full turn."""

    def __init__(self, angle: float, allowance_s: float, now_s: float, pose: Pose) -> None:
        self._angle, self._until_s = angle, now_s + allowance_s if allowance_s > 0 else math.inf
        self._yaw, self._turned = pose[2], 0.0

    def step(self, now_s: float, pose: Pose) -> Step:
        """Returns the next command; it slows down towards the end."""
        self._turned += wrapped(pose[2] - self._yaw)
        self._yaw = pose[2]
        covered, left = abs(self._turned), abs(self._angle) - self._turned * math.copysign(1, self._angle)
        if left <= 0.02:
            return Step(covered=covered, is_over=True)
        if now_s >= self._until_s:
            return Step(covered=covered, is_over=True, error="timeout")
        speed = min(max(1.5 * left, TURN_MIN), TURN_MAX)
        return Step(angular=math.copysign(speed, self._angle), covered=covered)


class Drive:
    """Drives straight: ahead with a positive speed, back with a negative one."""

    def __init__(  # noqa: PLR0913 - a distance, a speed, and where it begins
        self,
        distance: float,
        speed: float,
        allowance_s: float,
        now_s: float,
        *,
        pose: Pose,
        allows: Allows,
    ) -> None:
        self._distance, self._speed = abs(distance), speed
        self._until_s = now_s + allowance_s if allowance_s > 0 else math.inf
        self._start, self._allows = pose, allows

    def step(self, now_s: float, pose: Pose) -> Step:
        """Returns the next command. It ends before a place where the robot may not stand."""
        covered = math.dist(pose[:2], self._start[:2])
        if covered >= self._distance:
            return Step(covered=covered, is_over=True)
        if now_s >= self._until_s:
            return Step(covered=covered, is_over=True, error="timeout")
        ahead = math.copysign(
            min(abs(self._speed) * LOOK_AHEAD_S + 0.05, self._distance - covered), self._speed
        )
        x, y = pose[0] + ahead * math.cos(pose[2]), pose[1] + ahead * math.sin(pose[2])
        # A robot that stands too near to something may still leave.
        if not self._allows(x, y) and self._allows(pose[0], pose[1]):
            return Step(covered=covered, is_over=True, error="collision")
        return Step(linear=self._speed, covered=covered)
