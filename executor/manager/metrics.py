"""Metrics of the manager, in Prometheus' text format."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.session.ladder import State

if TYPE_CHECKING:
    from executor.session.protocol import Session

__all__ = ["CONTENT_TYPE", "Traffic", "metrics_text"]

CONTENT_TYPE: Final = "text/plain; version=0.0.4; charset=utf-8"


@dataclass
class Traffic:
    """Counters of a server."""

    clients: int = 0
    streams: int = 0
    commands: int = 0
    refusals: int = 0
    events: int = 0
    frames: int = 0
    snapshots: int = 0


def metrics_text(session: Session, traffic: Traffic) -> str:
    """Returns all metrics of a session."""
    mirror = session.mirror
    states = [f'bt_studio_session_state{{state="{state}"}} {int(state is session.state)}' for state in State]
    lines = [
        *_head("session_state", "gauge", "The rung on which the ladder stands."),
        *states,
        *_metric("clients", "gauge", "Clients that are connected.", traffic.clients),
        *_metric("streams", "gauge", "Clients that are sent frames.", traffic.streams),
        *_metric("commands_total", "counter", "Commands that came.", traffic.commands),
        *_metric("commands_refused_total", "counter", "Commands answered with an error.", traffic.refusals),
        *_metric("events_total", "counter", "Events sent, once for all clients.", traffic.events),
        *_metric("frames_total", "counter", "Frames that the world sent.", traffic.frames),
        *_metric("snapshots_total", "counter", "Snapshots for clients too slow.", traffic.snapshots),
        *_metric("faults", "gauge", "Faults of this run.", len(mirror.faults)),
        *_metric("ticks", "gauge", "Ticks of this run.", mirror.tick),
        *_metric("tick_seconds", "gauge", "How long a tick takes of late.", mirror.tick_ms / 1000),
        *_metric("simulated_seconds", "gauge", "Simulated time.", session.sim_time_s),
        *_metric("speed_wanted", "gauge", "Requested real-time factor.", mirror.speed),
        *_metric("real_time_factor", "gauge", "Of the last second.", mirror.real_time_factor),
        *_metric(
            "children", "gauge", "World, application and those that wait.", len(session.children.living)
        ),
        *_metric("open_descriptors", "gauge", "Of the manager.", len(list(Path("/proc/self/fd").iterdir()))),
        *_metric("memory_bytes", "gauge", "Resident, of the manager.", _resident_bytes()),
    ]
    return "\n".join(lines) + "\n"


def _head(name: str, kind: str, text: str) -> list[str]:
    return [f"# HELP bt_studio_{name} {text}", f"# TYPE bt_studio_{name} {kind}"]


def _metric(name: str, kind: str, text: str, value: float) -> list[str]:
    return [*_head(name, kind, text), f"bt_studio_{name} {value:g}"]


def _resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")
