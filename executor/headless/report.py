"""The report of a run that `bt-studio run --report` writes."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any, Final

WALL_FIELDS: Final = ("wall_time_s", "real_time_factor", "tick_ms", "overruns", "profile")
"""Fields that depend on the machine; all others are the same for the same project and seed."""


@dataclass
class NodeCount:
    """The number of ticks of a node, by result."""

    path: str
    ticks: int = 0
    success: int = 0
    failure: int = 0
    running: int = 0


@dataclass
class ProfileRow:
    """The time of a node, in ms: with the nodes below it, and without them."""

    path: str
    calls: int
    total_ms: float
    self_ms: float


@dataclass
class Report:
    """The report of a whole run.

    Distances and collisions are those of the first robot; lengths are in m, angles in rad.

    `random` is false if neither the world nor the actions used random numbers; every seed then gives the same
    run. `profile` has the nodes that were ticked, if they were measured.
    """

    root_status: str = "IDLE"
    ticks: int = 0
    sim_time_s: float = 0.0
    wall_time_s: float = 0.0
    real_time_factor: float = 0.0
    distance_m: float = 0.0
    collisions: int = 0
    hits: int = 0
    min_range_m: float | None = None
    tick_ms: dict[str, float] = field(default_factory=dict)
    overruns: int = 0
    trajectory: list[list[float]] = field(default_factory=list)
    nodes: list[NodeCount] = field(default_factory=list)
    errors: list[dict[str, Any]] = field(default_factory=list)
    random: bool = True
    profile: list[ProfileRow] = field(default_factory=list)

    def to_json(self) -> dict[str, Any]:
        """Returns the report as a JSON object."""
        return asdict(self)

    def without_wall_times(self) -> dict[str, Any]:
        """Returns the fields that are the same for every run with the same seed."""
        return {name: value for name, value in self.to_json().items() if name not in WALL_FIELDS}


def quantiles(durations_s: list[float]) -> dict[str, float]:
    """Returns the median, the 95th percentile and the maximum (`p50`, `p95`, …) in ms."""
    ordered = sorted(durations_s)
    if not ordered:
        return {"p50": 0.0, "p95": 0.0, "max": 0.0}

    def at(part: float) -> float:
        return round(ordered[min(len(ordered) - 1, math.ceil(part * len(ordered)) - 1)] * 1000, 3)

    return {"p50": at(0.5), "p95": at(0.95), "max": at(1.0)}
