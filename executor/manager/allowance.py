"""Limits the rate of commands of one client: a token bucket. Time is an argument."""

from __future__ import annotations

from typing import Final

__all__ = ["BURST", "COSTS", "RATE_HZ", "Allowance"]

# Driving and dragging by hand send 60 commands a second each; a page that reconnects sends some dozens at
# once.
RATE_HZ: Final = 250.0
BURST: Final = 500.0
COSTS: Final = {
    "list_topics": 10.0,
    "echo_topic": 4.0,
    "describe_type": 4.0,
    "read_recording": 4.0,
    "take_over": 4.0,
    "dap": 2.5,  # 100 a second
}
"""Commands that cost the world, or every client, more than one token."""


class Allowance:
    """The token bucket of one connection.

    Args:
        now_s: the time; the bucket is full then.
    """

    def __init__(self, now_s: float, *, rate_hz: float = RATE_HZ, burst: float = BURST) -> None:
        self.rate_hz = rate_hz
        self._burst = burst
        self._tokens = burst
        self._at_s = now_s

    def take(self, command: str, now_s: float) -> float:
        """Subtracts the cost of a command and returns 0.

        If too few tokens are left, returns the seconds to wait.
        """
        self._tokens = min(self._burst, self._tokens + (now_s - self._at_s) * self.rate_hz)
        self._at_s = now_s
        cost = COSTS.get(command, 1.0)
        if self._tokens < cost:
            return (cost - self._tokens) / self.rate_hz
        self._tokens -= cost
        return 0.0
