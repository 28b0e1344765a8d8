"""How an executor without any network is reached.

An executor's container has no network, and nothing that it can write is shared with anyone. It sees one
socket, the gate, through a read-only mount. When it starts it shows its token there, and is handed a
socket that listens already: at a path in a folder that only the web server sees. From then on the web server
and the executor talk to each other alone; a restart of the keeper or of the web server changes nothing.
A session that is given its socket is struck off, so that what runs in it later gets nothing.
"""

from __future__ import annotations

import contextlib
import hmac
import json
import os
import socket
import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

MAX_REQUEST_BYTES: Final = 4096
REQUEST_TIMEOUT_S: Final = 5
BACKLOG: Final = 16
EVERYBODY: Final = 0o666  # whoever sees the folder; it is mounted where it is meant to be seen


@dataclass
class _Expected:
    token: str
    listener: socket.socket
    arrived: threading.Event = field(default_factory=threading.Event)


class Gate:
    """Hands listening sockets to executors.

    Args:
        gate_folder: mounted read-only into every executor; holds `gate.sock` alone.
        socket_folder: where the sockets of the sessions are; only the web server sees it.
    """

    def __init__(self, gate_folder: Path, socket_folder: Path) -> None:
        self._socket_folder = socket_folder
        self._expected: dict[str, _Expected] = {}
        self._lock = threading.Lock()
        socket_folder.mkdir(parents=True, exist_ok=True)
        gate_folder.mkdir(parents=True, exist_ok=True)
        self._server = listen_at(gate_folder / "gate.sock")

    def serve(self) -> None:
        """Answers executors until the gate is closed."""
        while True:
            try:
                connection, _ = self._server.accept()
            except OSError:
                return
            threading.Thread(target=self._answer, args=(connection,), daemon=True).start()

    def close(self) -> None:
        """Lets nobody in any more."""
        with contextlib.suppress(OSError):
            self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()
        for session_id in list(self._expected):
            self.forget(session_id)

    def path(self, session_id: str) -> Path:
        """Where a session listens."""
        return self._socket_folder / f"{session_id}.sock"

    def expect(self, session_id: str, token: str) -> threading.Event:
        """Makes the socket of a session; the event is set when its executor has taken it."""
        self.forget(session_id)  # one that is started anew asks for another
        expected = _Expected(token, listen_at(self.path(session_id)))
        with self._lock:
            self._expected[session_id] = expected
        return expected.arrived

    def forget(self, session_id: str) -> None:
        """Takes back a socket that nobody fetched."""
        with self._lock:
            expected = self._expected.pop(session_id, None)
        if expected is not None:
            expected.listener.close()

    def remove(self, session_id: str) -> None:
        """Removes what is left of a session that has ended."""
        self.forget(session_id)
        self.path(session_id).unlink(missing_ok=True)

    def _answer(self, connection: socket.socket) -> None:
        with connection, contextlib.suppress(OSError, ValueError, KeyError, TypeError, AttributeError):
            connection.settimeout(REQUEST_TIMEOUT_S)
            request = json.loads(_line(connection))
            expected = self._admitted(str(request["session"]), str(request["token"]))
            if expected is None:
                connection.sendall(b"refused\n")
                return
            with expected.listener:
                socket.send_fds(connection, [b"listen\n"], [expected.listener.fileno()])
            expected.arrived.set()

    def _admitted(self, session_id: str, token: str) -> _Expected | None:
        with self._lock:
            expected = self._expected.get(session_id)
            if expected is None or not hmac.compare_digest(expected.token.encode(), token.encode()):
                return None
            return self._expected.pop(session_id)


def listen_at(path: Path) -> socket.socket:
    """A socket that listens at a path, in place of an older one."""
    path.unlink(missing_ok=True)
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    listener.bind(str(path))
    os.chmod(path, EVERYBODY)  # noqa: PTH101
    listener.listen(BACKLOG)
    return listener


def _line(connection: socket.socket) -> bytes:
    data = b""
    while not data.endswith(b"\n") and len(data) < MAX_REQUEST_BYTES:
        chunk = connection.recv(MAX_REQUEST_BYTES)
        if not chunk:
            break
        data += chunk
    return data
