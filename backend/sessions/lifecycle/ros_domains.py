"""The ROS domains in which programs of this host take part, ours and others."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Final

# RTPS 2.5, section 9.6.2: a participant of domain d binds UDP ports from 7400 + 250 d on.
_FIRST_PORT: Final = 7400
_PORTS_A_DOMAIN: Final = 250
_TABLES: Final = (Path("/proc/net/udp"), Path("/proc/net/udp6"))


def domains_on_this_host() -> set[int]:
    """Returns the domains whose ports are bound: of other servers, and of a user's own ROS programs."""
    return {
        (port - _FIRST_PORT) // _PORTS_A_DOMAIN
        for table in _TABLES
        for port in _bound_ports(table)
        if port >= _FIRST_PORT
    }


def _bound_ports(table: Path) -> list[int]:
    """Returns the local ports in a table of the kernel; none if it has no such table."""
    with suppress(OSError):
        lines = table.read_text(encoding="ascii").splitlines()[1:]
        return [int(line.split()[1].rpartition(":")[2], 16) for line in lines]
    return []
