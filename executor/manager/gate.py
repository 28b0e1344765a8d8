"""Fetches a listening socket for a manager without a network.

A manager in a container without a network and without a shared writable folder cannot create a reachable
socket. The keeper beside the web server creates one, and passes it through the gate: a unix socket for this
session (its "door"), which the container sees through a read-only mount (`backend/sessions/gate`).
"""

from __future__ import annotations

import json
import socket
import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["fetch_listener"]

TIMEOUT_S: Final = 10.0
RETRY_S: Final = 0.1


def fetch_listener(door: Path, session_id: str, token: str, *, timeout_s: float = TIMEOUT_S) -> socket.socket:
    """Returns the session's listening socket. If the gate restarts, waits for it.

    Raises:
        OSError: the gate's unix socket (`door`) does not exist or does not answer, or the gate refuses this
            session.
    """
    deadline_s = time.monotonic() + timeout_s
    while True:
        try:
            return _fetch(door, session_id, token)
        except (FileNotFoundError, BlockingIOError, ConnectionError):
            if time.monotonic() >= deadline_s:
                raise
            time.sleep(RETRY_S)


def _fetch(door: Path, session_id: str, token: str) -> socket.socket:
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
        connection.settimeout(TIMEOUT_S)
        connection.connect(str(door))
        connection.sendall(json.dumps({"session": session_id, "token": token}).encode() + b"\n")
        answer, descriptors, _, _ = socket.recv_fds(connection, 16, 1)
    if descriptors:
        return socket.socket(fileno=descriptors[0])
    if not answer:
        raise ConnectionResetError("the gate closed the connection")
    raise PermissionError("the gate does not know this session")
