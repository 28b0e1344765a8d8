"""The gait of a person: walks along a path at constant speed, with swinging legs. Pure geometry."""

from __future__ import annotations

import bisect
import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor.world.geometry.transforms import wrap

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

STRIDE_M: Final = 1.3
LARGEST_SWING: Final = 0.5  # rad, at full pace
FULL_PACE: Final = 1.2  # m/s
TURN_RATE: Final = 3.0  # rad/s
AHEAD_M: Final = (0.1, 0.2, 0.3)
"""How far along the path one who yields looks."""
ROOM_M: Final = 0.3
"""The least distance of a person's middle from a robot's circle, for one who yields."""

Circle = tuple[float, float, float]
"""x, y and radius in m."""


class Path:
    """A polyline along which an actor walks: in a circle if `loop` is set, otherwise back and forth."""

    def __init__(self, points: Sequence[tuple[float, float]], *, loop: bool) -> None:
        closed = [*points, points[0]] if loop or len(points) == 1 else [*points, *reversed(points[:-1])]
        self._points = closed
        self._ends = [0.0]
        for a, b in itertools.pairwise(closed):
            self._ends.append(self._ends[-1] + math.dist(a, b))

    @property
    def length_m(self) -> float:
        """The length of one lap."""
        return self._ends[-1]

    def at(self, distance_m: float) -> tuple[float, float, float]:
        """Returns x, y and heading after a distance."""
        if self.length_m <= 0:
            return (*self._points[0], 0.0)
        along = distance_m % self.length_m
        i = min(bisect.bisect_right(self._ends, along), len(self._ends) - 1)
        a, b = self._points[i - 1], self._points[i]
        part = (along - self._ends[i - 1]) / max(self._ends[i] - self._ends[i - 1], 1e-9)
        return (
            a[0] + (b[0] - a[0]) * part,
            a[1] + (b[1] - a[1]) * part,
            math.atan2(b[1] - a[1], b[0] - a[0]),
        )


@dataclass(frozen=True)
class Gait:
    """Pose of a walker; `swing` is the angle in rad of the left leg and of the right arm."""

    x: float
    y: float
    yaw: float
    swing: float
    distance_m: float


class Walker:
    """A person who walks along a path.

    The heading follows that of the path with a limited rate, which makes corners natural.
    """

    def __init__(self, path: Path, speed: float, start_m: float = 0.0) -> None:
        self._path = path
        self._speed = speed
        self.gait = self._gait(start_m, path.at(start_m)[2])

    def is_in_the_way(self, circle: Circle) -> bool:
        """Returns whether the next steps lead into a circle, or nearer to it than one wants to be."""
        *middle, radius = circle
        now = math.dist((self.gait.x, self.gait.y), middle)
        ahead = (math.dist(self._path.at(self.gait.distance_m + m)[:2], middle) for m in AHEAD_M)
        return any(distance < min(now, radius + ROOM_M) for distance in ahead)

    def advance(self, dt_s: float, yield_to: Iterable[Circle] = ()) -> Gait:
        """Walks for `dt_s`, or waits while a circle is in the way; returns the new pose."""
        if any(self.is_in_the_way(circle) for circle in yield_to):
            return self.gait
        distance = self.gait.distance_m + self._speed * dt_s
        wanted = wrap(self._path.at(distance)[2] - self.gait.yaw)
        limit = TURN_RATE * dt_s
        self.gait = self._gait(distance, wrap(self.gait.yaw + max(-limit, min(limit, wanted))))
        return self.gait

    def _gait(self, distance: float, yaw: float) -> Gait:
        x, y, _ = self._path.at(distance)
        pace = min(1.0, self._speed / FULL_PACE) ** 0.5 if self._path.length_m > 0 else 0.0
        swing = LARGEST_SWING * pace * math.sin(2 * math.pi * distance / STRIDE_M)
        return Gait(x, y, yaw, swing, distance)
