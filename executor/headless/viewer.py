"""Serves a page on loopback that shows a run: pictures of the world, and figures.

It needs no build and no web server, so every run can have it.
"""

from __future__ import annotations

import contextlib
import hmac
import logging
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import parse_qs, urlsplit

import msgspec
from websockets.asyncio.server import Server, ServerConnection, broadcast, serve
from websockets.exceptions import ConnectionClosed

from executor.messages import CameraPose

if TYPE_CHECKING:
    from collections.abc import Callable

    from websockets.http11 import Request, Response

__all__ = ["RunViewer"]

_PAGE: Final = Path(__file__).with_name("page")
_FILES: Final = {
    "/": ("index.html", "text/html; charset=utf-8"),
    "/viewer.css": ("viewer.css", "text/css; charset=utf-8"),
    "/viewer.js": ("viewer.js", "text/javascript; charset=utf-8"),
}
_POLICY: Final = "default-src 'self'; img-src blob:; base-uri 'none'; frame-ancestors 'none'"
MAX_MESSAGE_BYTES: Final = 1024
PING: Final = "ping"
_pose_of = msgspec.json.Decoder(CameraPose).decode


class RunViewer:
    """Serves the page until it is closed; a slow browser misses pictures without delaying others.

    Args:
        token: a part of the link; viewers must send it.
        look: called with the camera that a viewer chose, and with None when the last viewer leaves.
    """

    def __init__(self, token: str, look: Callable[[CameraPose | None], None]) -> None:
        self._token = token
        self._look = look
        self._figures = ""
        self._picture = b""
        self._hosts: frozenset[str] = frozenset()
        self._server: Server | None = None

    async def start(self) -> str:
        """Listens on a free port of loopback; returns the link to the page."""
        logging.getLogger("websockets.server").setLevel(logging.ERROR)
        self._server = await serve(
            self._serve,
            "127.0.0.1",
            0,
            process_request=self._answer,
            max_size=MAX_MESSAGE_BYTES,
            compression=None,
            server_header=None,
        )
        port = next(iter(self._server.sockets)).getsockname()[1]
        self._hosts = frozenset({f"127.0.0.1:{port}", f"localhost:{port}"})
        return f"http://127.0.0.1:{port}/?token={self._token}"

    def show(self, jpeg: bytes) -> None:
        """Shows the next picture."""
        self._picture = jpeg
        self._send(jpeg)

    def tell(self, figures: dict[str, Any]) -> None:
        """Shows the figures of the run on the page."""
        self._figures = msgspec.json.encode(figures).decode()
        self._send(self._figures)

    async def close(self) -> None:
        """Stops serving; viewers keep the last picture."""
        if self._server is not None:
            self._server.close()
            await self._server.wait_closed()

    def _send(self, message: str | bytes) -> None:
        if self._server is not None:
            idle = [c for c in self._server.connections if not c.transport.get_write_buffer_size()]
            broadcast(idle, message)

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        url = urlsplit(request.path)
        if request.headers.get("Host") not in self._hosts:
            return connection.respond(HTTPStatus.FORBIDDEN, "This page is for this machine only.\n")
        if url.path == "/socket":
            return self._admit(connection, request, url.query)
        if url.path not in _FILES:
            return connection.respond(HTTPStatus.NOT_FOUND, "There is nothing here.\n")
        name, kind = _FILES[url.path]
        response = connection.respond(HTTPStatus.OK, (_PAGE / name).read_text())
        del response.headers["Content-Type"]
        response.headers.update(
            {"Content-Type": kind, "Content-Security-Policy": _POLICY, "Referrer-Policy": "no-referrer"}
        )
        return response

    def _admit(self, connection: ServerConnection, request: Request, query: str) -> Response | None:
        given = parse_qs(query).get("token", [""])[0]
        origin = request.headers.get("Origin", "").removeprefix("http://")
        if hmac.compare_digest(given.encode(), self._token.encode()) and origin in self._hosts:
            return None
        return connection.respond(HTTPStatus.FORBIDDEN, "Open the link that bt-studio run printed.\n")

    async def _serve(self, connection: ServerConnection) -> None:
        with contextlib.suppress(ConnectionClosed):
            for known in (self._figures, self._picture):
                if known:
                    await connection.send(known)
            async for message in connection:
                if message == PING:
                    await connection.send(PING)
                    continue
                with contextlib.suppress(msgspec.DecodeError):
                    self._look(_pose_of(message))
        if self._server is not None and not self._server.connections - {connection}:
            self._look(None)
