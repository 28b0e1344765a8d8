"""Starts and ends executors through the keeper of another host, which its relay leads to."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from backend.sessions.hosts.dial import NotReachedError, RelayedHTTPConnection
from backend.sessions.keeper.unix_http import exchange
from backend.sessions.launchers.docker import DockerLauncher
from backend.sessions.relay.hello import KEEPER

if TYPE_CHECKING:
    from collections.abc import Callable

    from backend.sessions.hosts.names import HostAddress

__all__ = ["RelayedLauncher"]

CONNECT_S: Final = 5.0
PAUSE_S: Final = 5.0
"""Seconds for which a host that did not answer is asked nothing: its sessions cost one wait together."""


class RelayedLauncher(DockerLauncher):
    """The executors of another host.

    Args:
        host: where its relay listens.
    """

    name = "docker"

    def __init__(self, host: HostAddress, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._host = host
        self._clock = clock
        self._paused_until_s = float("-inf")

    def greet(self) -> None:
        """Asks the keeper for its sessions, even if it did not answer a moment ago."""
        self._paused_until_s = float("-inf")
        super().greet()

    def request(self, method: str, target: str, body: object, timeout_s: float) -> tuple[int, bytes]:
        """Makes one request to the keeper of the host."""
        if self._clock() < self._paused_until_s:
            raise NotReachedError(f"the host {self._host} did not answer a moment ago")
        connection = RelayedHTTPConnection(self._host, KEEPER, timeout_s, min(CONNECT_S, timeout_s))
        try:
            return exchange(connection, method, target, body)
        except (NotReachedError, TimeoutError):
            self._paused_until_s = self._clock() + PAUSE_S
            raise

    def address_of(self, made_id: str, answer: dict[str, Any]) -> str:
        """Returns the address of a session or of tools on the host."""
        return f"tls://{self._host}/{made_id}"
