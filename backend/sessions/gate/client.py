"""The keeper's messages to the gate: a session's door is open while its `Door` object is open."""

from __future__ import annotations

import contextlib
import json
import secrets
import socket
import time
from typing import TYPE_CHECKING, Final, Self

from backend.sessions.gate.doors import DOOR_SOCKET
from backend.sessions.gate.errors import GateError
from backend.sessions.gate.server import MAX_LINE_BYTES, OPEN, REFUSALS, TAKEN

if TYPE_CHECKING:
    from pathlib import Path

OPEN_TIMEOUT_S: Final = 10.0
RETRY_S: Final = 0.1


class Door:
    """The door of one session: the unix socket at which the session fetches its listening socket.

    A restarted gate knows no doors. The door is then opened again with the same name, since the session knows
    that name.

    Args:
        control: the path at which the gate listens for the keeper.
        listener: the socket for the session; the caller keeps it open until the door is closed.
    """

    def __init__(self, control: Path, listener: socket.socket, session: str, token: str) -> None:
        self.name = secrets.token_hex(16)
        self._control = str(control)
        self._listener = listener
        asked = {"door": self.name, "session": session, "token": token}
        self._request = json.dumps(asked).encode() + b"\n"
        self._connection: socket.socket | None = None
        self._heard = b""

    @property
    def path(self) -> str:
        """The path of the door in the folder of the doors."""
        return f"{self.name}/{DOOR_SOCKET}"

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def open(self, timeout_s: float = OPEN_TIMEOUT_S) -> Self:
        """Opens the door; if the gate is starting, waits for it. Returns this object.

        Raises:
            GateError: the gate does not answer, or refuses.
        """
        deadline_s = time.monotonic() + timeout_s
        while True:
            try:
                self._connect(max(0.1, deadline_s - time.monotonic()))
            except (OSError, GateError) as error:
                self.close()
                if time.monotonic() >= deadline_s:
                    if isinstance(error, GateError):
                        raise
                    raise GateError("gate_unreachable", f"The gate does not answer: {error}.") from error
                time.sleep(RETRY_S)
            else:
                return self

    def wait(self, timeout_s: float) -> bool:
        """Waits until a session has fetched its socket; returns False if the time runs out first."""
        deadline_s = time.monotonic() + timeout_s
        try:
            connection = self._connection or self._connect(timeout_s)
            return self._hear(connection, timeout_s) == TAKEN
        except TimeoutError:
            return False
        except (OSError, GateError):
            self.close()
            time.sleep(max(0.0, min(RETRY_S, deadline_s - time.monotonic())))
            return False

    def close(self) -> None:
        """Closes the door; may be called twice."""
        if self._connection is not None:
            self._connection.close()
        self._connection = None
        self._heard = b""

    def _connect(self, timeout_s: float) -> socket.socket:
        self._connection = connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        connection.settimeout(timeout_s)
        connection.connect(self._control)
        # A gate that has no descriptors left answers before it is asked, and closes.
        with contextlib.suppress(BrokenPipeError):
            socket.send_fds(connection, [self._request], [self._listener.fileno()])
        answer = self._hear(connection, timeout_s)
        if answer != OPEN:
            raise GateError("gate_refused", f"The gate refuses: {REFUSALS.get(answer, 'unknown answer')}.")
        return connection

    def _hear(self, connection: socket.socket, timeout_s: float) -> bytes:
        """Returns one line that the gate sends."""
        connection.settimeout(timeout_s)
        while b"\n" not in self._heard:
            data = connection.recv(MAX_LINE_BYTES)
            if not data:
                raise ConnectionResetError("the gate has ended")
            self._heard += data
        line, end, self._heard = self._heard.partition(b"\n")
        return line + end
