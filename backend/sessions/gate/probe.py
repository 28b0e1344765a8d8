"""The health check: opens a door as the keeper does, and uses it as a session does."""

from __future__ import annotations

import json
import secrets
import socket
from typing import TYPE_CHECKING, Final

from backend.sessions.gate.client import Door
from backend.sessions.gate.errors import GateError

if TYPE_CHECKING:
    from pathlib import Path

SESSION: Final = "health check"
TIMEOUT_S: Final = 4.0


def probe(control: Path, doors: Path, timeout_s: float = TIMEOUT_S) -> None:
    """Waits until a socket was passed through the gate.

    Raises:
        GateError: the gate does not answer or refuses.
        OSError: the door does not answer, or passes something else.
    """
    token = secrets.token_hex(32)
    ours, handed = socket.socketpair()
    with ours, handed, Door(control, handed, SESSION, token) as door:
        door.open(timeout_s)
        with _fetch(doors / door.path, token, timeout_s) as fetched:
            fetched.sendall(token.encode())
        ours.settimeout(timeout_s)
        if ours.recv(len(token)) != token.encode():
            raise GateError("gate_wrong", "The gate handed out another socket.")
        if not door.wait(timeout_s):
            raise GateError("gate_wrong", "The gate did not say that the socket was taken.")
    if (doors / door.name).exists():
        raise GateError("gate_wrong", f"The gate left the door {door.name}.")


def _fetch(door: Path, token: str, timeout_s: float) -> socket.socket:
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as caller:
        caller.settimeout(timeout_s)
        caller.connect(str(door))
        caller.sendall(json.dumps({"session": SESSION, "token": token}).encode() + b"\n")
        _, descriptors, _, _ = socket.recv_fds(caller, 16, 1)
    if not descriptors:
        raise GateError("gate_wrong", "The gate handed out nothing.")
    return socket.socket(fileno=descriptors[0])
