"""The ROS domains in which programs of this host take part, ours and others, and the choice of a free one."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import Final

from backend.sessions.errors import HostFullError
from backend.sessions.models import LIVE_STATES, Session

# Domains whose UDP ports lie below Linux's ephemeral range, without 0, which everybody uses.
ROS_DOMAINS: Final = range(1, 102)

# RTPS 2.5, section 9.6.2: a participant of domain d binds UDP ports from 7400 + 250 d on.
_FIRST_PORT: Final = 7400
_PORTS_A_DOMAIN: Final = 250
_TABLES: Final = (Path("/proc/net/udp"), Path("/proc/net/udp6"))


def free_domain() -> int:
    """Returns a domain that no session has, and if possible no other program of this host.

    Raises:
        HostFullError: sessions have all domains.
    """
    taken = set(Session.objects.filter(state__in=LIVE_STATES).values_list("ros_domain_id", flat=True))
    # The first domain differs among servers on one host, so that their first sessions do not collide.
    offset = os.getpid() % len(ROS_DOMAINS)
    candidates = [domain for domain in [*ROS_DOMAINS[offset:], *ROS_DOMAINS[:offset]] if domain not in taken]
    if not candidates:
        raise HostFullError("Every ROS domain of this host is in use.", hint="End a session and try again.")
    others = domains_on_this_host()
    free: int = next((domain for domain in candidates if domain not in others), candidates[0])
    return free


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
