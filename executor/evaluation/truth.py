"""The truth of a run as typed records, on which judges decide."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from executor.evaluation.areas import contains

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    Corners = Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Sample:
    """The state at one moment: true pose of the robot in m and rad, and positions of the actors in m."""

    time_s: float
    x: float
    y: float
    yaw: float
    actors: Mapping[str, tuple[float, float]]
    root: str
    """The result of the tree, once it has ended; RUNNING before."""


@dataclass(frozen=True)
class Bump:
    """The start of a collision of the robot, where it stood, and the id of what it hit."""

    time_s: float
    x: float
    y: float
    body: str


@dataclass
class Truth:
    """A whole run, up to now. A function of a judge gets it, and may only read it.

    Attributes:
        areas: the corners of the universe's areas.
        samples: twenty a second.
        bumps: the collisions of the robot.
        path_length_m: the distance that the robot has travelled.
        smallest_clearance_m: the smallest distance so far from anything; None if nothing was within 5 m.
        energy_j: the mechanical energy of the wheels.
    """

    areas: Mapping[str, Corners] = field(default_factory=dict)
    samples: list[Sample] = field(default_factory=list)
    bumps: list[Bump] = field(default_factory=list)
    path_length_m: float = 0.0
    smallest_clearance_m: float | None = None
    energy_j: float = 0.0

    @property
    def time_s(self) -> float:
        """The time of the last sample."""
        return self.samples[-1].time_s if self.samples else 0.0

    def is_inside(self, area: str, x: float, y: float) -> bool:
        """Returns whether a point lies in an area.

        Raises:
            KeyError: the universe has no such area.
        """
        return contains(self.areas[area], x, y)
