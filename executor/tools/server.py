"""The socket of the tools.

There are `/language` for an open editor, `/ruff` for the checker, `/tests` for tests, `/uploads` for imports.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import tempfile
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Final

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from executor.supervision.scratch import Scratch
from executor.tools.behaviours import serve_behaviours
from executor.tools.checker import serve_checker
from executor.tools.language import serve_editor
from executor.tools.uploads import serve_uploads

if TYPE_CHECKING:
    import socket
    import ssl

    from websockets.http11 import Request, Response

__all__ = ["ToolsServer"]

MAX_MESSAGE_BYTES: Final = 300 << 20  # bytes; all Python files of the largest project, or the largest upload
MAX_CLIENTS: Final = 16
HEARTBEAT_S: Final = 15.0


class ToolsServer:
    """Serves the editors of one user.

    Args:
        listener: the socket on which the server listens.
        token: the token that clients must send as `Authorization: Bearer`.
        grace_s: the seconds for which the server waits without clients before it ends.
        tls: what encrypts connections from another machine; None on a unix socket.
    """

    def __init__(
        self, listener: socket.socket, token: str, *, grace_s: float, tls: ssl.SSLContext | None = None
    ) -> None:
        self._listener = listener
        self._expected = f"Bearer {token}".encode()
        self._grace_s = grace_s
        self._tls = tls
        self._clients = 0
        self._ended = asyncio.Event()
        self._timer: asyncio.TimerHandle | None = None

    async def run(self) -> None:
        """Serves until `end` is called, or until no client was connected for the grace period."""
        scratch = Scratch()  # also removed if this process is killed
        try:
            self._root = scratch.path
            options = {"process_request": self._check, "max_size": MAX_MESSAGE_BYTES, "compression": None}
            options |= {"ping_interval": HEARTBEAT_S, "ping_timeout": HEARTBEAT_S}
            async with serve(self._serve, sock=self._listener, ssl=self._tls, **options):  # type: ignore[arg-type]
                self._wait_for_clients()
                await self._ended.wait()
        finally:
            scratch.remove()

    def end(self) -> None:
        """Makes `run` return."""
        self._ended.set()

    def _wait_for_clients(self) -> None:
        self._timer = asyncio.get_running_loop().call_later(self._grace_s, self.end)

    def _check(self, connection: ServerConnection, request: Request) -> Response | None:
        given = request.headers.get("Authorization", "").encode()
        if not hmac.compare_digest(given, self._expected):
            return connection.respond(HTTPStatus.UNAUTHORIZED, "The token is missing or wrong.\n")
        if request.path not in {"/language", "/ruff", "/tests", "/uploads"}:
            text = "There are /language, /ruff, /tests and /uploads.\n"
            return connection.respond(HTTPStatus.NOT_FOUND, text)
        if self._clients >= MAX_CLIENTS:
            return connection.respond(HTTPStatus.SERVICE_UNAVAILABLE, "There are too many editors.\n")
        return None

    async def _serve(self, connection: ServerConnection) -> None:
        assert connection.request is not None  # noqa: S101 - the handshake is over
        self._clients += 1
        if self._timer is not None:
            self._timer.cancel()
        try:
            with contextlib.suppress(ConnectionClosed):
                if connection.request.path == "/ruff":
                    await serve_checker(connection)
                elif connection.request.path == "/tests":
                    await serve_behaviours(connection)
                elif connection.request.path == "/uploads":
                    await serve_uploads(connection, self._root)
                else:
                    with tempfile.TemporaryDirectory(dir=self._root) as home:
                        await serve_editor(connection, Path(home))
        finally:
            self._clients -= 1
            if not self._clients:
                self._wait_for_clients()
