"""Collects the report of a run from its events and frames."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from executor import messages
from executor.headless.report import NodeCount, ProfileRow, Report, quantiles
from executor.stream.pose_codec import POSE_BYTES, unpack

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Measured"]


@dataclass
class Measured:
    """The report of a run, updated during the run."""

    report: Report = field(default_factory=Report)
    period_ms: float = 50.0
    finished: bool = False
    _paths: dict[int, NodeCount] = field(default_factory=dict)
    _running: set[int] = field(default_factory=set)
    _durations_s: list[float] = field(default_factory=list)
    _base: int = -1
    _start_s: float | None = None

    def take_event(self, name: str, data: dict[str, Any], time_s: float) -> None:
        """Adds an event to the report; `time_s` is its simulated time."""
        report = self.report
        match name:
            case "tree":
                self._paths = {node["uid"]: NodeCount(node["path"]) for node in data["nodes"]}
                report.nodes = list(self._paths.values())
            case "tick":
                self._take_tick(data, time_s)
            case "sim":
                report.distance_m = data["distance_m"]
                report.collisions, report.hits = data["collisions"], data["hits"]
            case "profile":
                report.profile = [
                    ProfileRow(self._paths[n["uid"]].path, n["calls"], n["total_ms"], n["self_ms"])
                    for n in data["nodes"]
                ]
            case "fault":
                report.errors.append(data)
            case "finished":
                report.root_status, self.finished = data["status"], True
            case _:
                pass

    def _take_tick(self, data: dict[str, Any], time_s: float) -> None:
        ticks = data["n"] - self.report.ticks
        self.report.ticks = data["n"]
        self._start_s = time_s if self._start_s is None else self._start_s
        self.report.sim_time_s = time_s - self._start_s
        self._durations_s.append(data["duration_ms"] / 1000.0)
        for uid, status in data["changed"]:
            (self._running.add if status == "RUNNING" else self._running.discard)(uid)
        for uid in self._running:
            self._paths[uid].ticks += ticks
            self._paths[uid].running += ticks
        for uid, status in data["changed"] + data["flashed"]:
            node = self._paths[uid]
            node.success += status == "SUCCESS"
            node.failure += status == "FAILURE"
            node.ticks += status in {"SUCCESS", "FAILURE"}

    def take_frame(self, frame: object) -> None:
        """Adds the robot's pose of a frame, or the nearest range of a scan, to the report."""
        match frame:
            case messages.Scene():
                robots = (o.id for o in frame.objects if o.kind == "robot")
                self._base = next(robots, -1)
            case messages.Poses():
                ids = list(memoryview(frame.ids).cast("H"))
                if self._base in ids:
                    at = ids.index(self._base) * POSE_BYTES
                    pose = unpack(frame.poses[at : at + POSE_BYTES])
                    self.report.trajectory.append(_trajectory_point(frame.t, pose))
            case messages.Scan():
                ranges = [r for r in memoryview(frame.ranges).cast("f") if math.isfinite(r) and r > 0]
                nearest = [*ranges, *([] if self.report.min_range_m is None else [self.report.min_range_m])]
                self.report.min_range_m = min(nearest, default=None)
            case _:
                pass

    @property
    def status(self) -> str:
        """Returns the root's status."""
        if self.report.root_status not in {"", "IDLE"}:
            return self.report.root_status
        return "RUNNING" if min(self._paths, default=0) in self._running else "IDLE"

    def end(self, wall_time_s: float) -> Report:
        """Returns the report of the whole run."""
        report = self.report
        report.root_status = self.status
        report.wall_time_s = wall_time_s
        report.real_time_factor = report.sim_time_s / wall_time_s if wall_time_s > 0 else 0.0
        report.tick_ms = quantiles(self._durations_s)
        report.overruns = sum(d * 1000.0 > self.period_ms for d in self._durations_s)
        return report


def _trajectory_point(time_s: float, pose: Sequence[float]) -> list[float]:
    x, y, _, qx, qy, qz, qw = pose
    yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    return [round(v, 4) for v in (time_s, x, y, yaw)]
