"""The keeper's side of the gate (`backend/sessions/gate`): paths of sockets, and doors of sessions."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from backend.sessions.gate.client import OPEN_TIMEOUT_S, Door
from backend.sessions.gate.doors import listen_at
from backend.sessions.gate.errors import GateError
from backend.sessions.keeper.errors import KeeperError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class Gate:
    """Requests sockets for sessions from the gate.

    Args:
        control: the path at which the gate listens for the keeper.
        socket_folder: the folder with the sockets of the sessions, which no session sees.
        patience_s: seconds to wait for a gate that does not answer, since it may be restarting.
    """

    def __init__(self, control: Path, socket_folder: Path, *, patience_s: float = OPEN_TIMEOUT_S) -> None:
        self._control = control
        self._socket_folder = socket_folder
        self._patience_s = patience_s
        socket_folder.mkdir(parents=True, exist_ok=True)

    def path(self, session_id: str) -> Path:
        """Returns the path of a session's socket."""
        return self._socket_folder / f"{session_id}.sock"

    @contextmanager
    def door(self, session_id: str, token: str) -> Iterator[Door]:
        """Makes the socket of a session, and keeps the session's door open during the context.

        Raises:
            KeeperError: the gate does not answer, or refuses.
        """
        path = self.path(session_id)
        with listen_at(path) as listener, Door(self._control, listener, session_id, token) as door:
            try:
                door.open(self._patience_s)
            except GateError as error:
                raise KeeperError(503, error.code, error.detail) from error
            yield door

    def remove(self, session_id: str) -> None:
        """Removes the socket of a session that has ended."""
        self.path(session_id).unlink(missing_ok=True)
