"""Counters of the manager's server."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Traffic:
    """What came and went through the sockets."""

    clients: int = 0
    streams: int = 0
    commands: int = 0
    refusals: int = 0
    events: int = 0
    frames: int = 0
    snapshots: int = 0
