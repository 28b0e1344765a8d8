"""How a manager without a network comes to be reached: it is handed a socket that listens already.

In a container without a network, and with nothing to write to that others see, a manager can make no socket
that anyone could find. The keeper beside the web server makes one and passes it through the gate, a unix
socket that the container sees through a read-only mount (`backend/sessions/keeper/gate.py`).
"""

from __future__ import annotations

import json
import socket
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["fetch_listener"]

TIMEOUT_S: Final = 10.0


def fetch_listener(gate: Path, session_id: str, token: str) -> socket.socket:
    """Returns the session's listening socket.

    Raises:
        OSError: nobody answers at the gate, or it refuses this session.
    """
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
        connection.settimeout(TIMEOUT_S)
        connection.connect(str(gate))
        connection.sendall(json.dumps({"session": session_id, "token": token}).encode() + b"\n")
        _, descriptors, _, _ = socket.recv_fds(connection, 16, 1)
    if not descriptors:
        raise PermissionError("the gate does not know this session")
    return socket.socket(fileno=descriptors[0])
