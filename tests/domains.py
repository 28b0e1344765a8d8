"""ROS domains for tests: test runs share a machine, and one graph would see the nodes of another."""

from __future__ import annotations

import random
import socket
from typing import Final

from executor.manager.manager import LARGEST_DOMAIN_ID, LAST_DOMAIN_ID

__all__ = ["own_domain_id"]

_held: Final[list[socket.socket]] = []


def own_domain_id() -> int:
    """Returns a domain that neither a session nor another process of tests uses, until this one ends."""
    sessions_use_lower = LAST_DOMAIN_ID + 1
    numbers = range(sessions_use_lower, LARGEST_DOMAIN_ID + 1)
    for number in random.sample(numbers, len(numbers)):
        lock = socket.socket(socket.AF_UNIX)
        try:
            lock.bind(f"\0bt-studio-tests-domain-{number}")
        except OSError:
            lock.close()
            continue
        _held.append(lock)
        return number
    raise OSError("tests use every ROS domain of this machine")
