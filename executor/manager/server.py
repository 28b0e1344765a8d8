"""The session's two sockets on loopback: `/control` (JSON) and `/stream` (MessagePack), and `/health`.

The server has no rules of its own: it decodes commands for the state machine and sends its events.
A frame that is not a command is answered with an error, and the socket stays open.

No client can block the others: the server reads, handles and sends a little for each client in turn. A client
that exceeds its allowance gets an error that says how long to wait. `/watch` is a health check: a socket that
answers pings, without a queue of commands.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from dataclasses import dataclass
from http import HTTPStatus
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import parse_qs, urlsplit

import msgspec
from msgspec import UNSET, Struct
from websockets.asyncio.server import Server, ServerConnection, serve, unix_serve
from websockets.exceptions import ConnectionClosed

from executor.manager.admission import Admission, is_loopback
from executor.manager.allowance import Allowance
from executor.manager.identity import USER_HEADER, user_of
from executor.manager.recordings import Recordings, is_recording
from executor.messages import COMMANDS, ClientMessage, Empty, Error, ServerMessage
from executor.session.events import (
    ClientJoined,
    ClientLeft,
    CommandCame,
    Event,
    Send,
    StreamClosed,
    StreamOpened,
    StreamPaced,
)
from executor.stream.outbox import ControlOutbox, StreamOutbox

if TYPE_CHECKING:
    import socket
    import ssl
    from collections.abc import Callable

    from websockets.http11 import Request, Response

    from executor.child_messages import Frame
    from executor.session.protocol import Session

__all__ = ["SessionServer", "Traffic"]

_log = logging.getLogger(__name__)

MAX_COMMAND_BYTES: Final = 128 << 20
OPEN_S: Final = 60.0
"""How long a request may take, such as for a recording that is joined first on a busy machine."""
MAX_QUEUED: Final = 2
"""Commands of a client that wait for their turn while another one is handled; a command can be large."""
MAX_CLIENTS: Final = 32
HEARTBEAT_S: Final = 15.0
REPLACED: Final = 4409
UNEXPECTED: Final = 1003
# Bytes that are read from a client at a time. All frames in them are parsed before another client's turn.
READ_BYTES: Final = 4 << 10
COMMANDS_IN_TURN: Final = 8
MESSAGES_IN_TURN: Final = 16
_encode = msgspec.json.Encoder().encode


@dataclass
class Traffic:
    """Counters of the messages of a server."""

    clients: int = 0
    streams: int = 0
    commands: int = 0
    refusals: int = 0
    events: int = 0
    frames: int = 0
    snapshots: int = 0


class SessionServer:
    """Serves one session.

    Args:
        session: makes ids of clients and snapshots.
        report: is called with each event for the state machine.
        admission: the access rules.
    """

    def __init__(self, session: Session, report: Callable[[Event], None], admission: Admission) -> None:
        self._session = session
        self._report = report
        self._admission = admission
        self._controls: dict[str, ControlOutbox] = {}
        self._connections: dict[str, ServerConnection] = {}
        self._stream_connections: dict[str, ServerConnection] = {}
        self._closing: set[asyncio.Task[None]] = set()
        self._streams: dict[str, StreamOutbox] = {}
        self.recordings: Recordings | None = None
        self._seq = 0
        self.traffic = Traffic()
        self._servers: list[Server] = []

    async def start(self, host: str, port: int, tls: ssl.SSLContext | None = None) -> int:
        """Listens, with TLS if there is a context for it; returns the port.

        Raises:
            OSError: the port is in use, or the address is not loopback and no token is required.
        """
        if not self._admission.token and not is_loopback(host):
            raise OSError(f"without a token a manager listens on loopback alone, not on {host}")
        server = await serve(self._serve, host, port, ssl=tls, **self._options)
        self._servers.append(server)
        return int(next(iter(server.sockets)).getsockname()[1])

    async def start_at(self, listener: socket.socket) -> None:
        """Listens on a given unix socket, in addition to the port."""
        self._servers.append(await unix_serve(self._serve, sock=listener, **self._options))

    @property
    def _options(self) -> dict[str, Any]:
        return {
            "process_request": self._check_request,
            "open_timeout": OPEN_S,
            "max_size": MAX_COMMAND_BYTES,
            "max_queue": MAX_QUEUED,
            "compression": None,
            "ping_interval": HEARTBEAT_S,
            "ping_timeout": HEARTBEAT_S,
            "server_header": None,
        }

    async def close(self) -> None:
        """Closes all connections."""
        for server in self._servers:
            server.close()
            await server.wait_closed()

    def send(self, effect: Send) -> None:
        """Queues an event for a client, or for all."""
        self.traffic.refusals += effect.name == "error"
        self.traffic.events += 1
        payload = msgspec.Raw(_encode(effect.payload))
        if effect.client is not None:
            self._queue(effect.client, effect.name, payload, effect.request)
            return
        data = self._envelope(effect.name, payload, None)
        for outbox in self._controls.values():
            outbox.put(data, is_reply=False)

    def send_frame(self, frame: Frame) -> None:
        """Queues a frame of the world for its client."""
        client = frame.client
        self.traffic.frames += 1
        now_s = time.monotonic()
        for name, outbox in list(self._streams.items()) if client is None else self._stream_of(client):
            outbox.put(frame.stream, frame.data)
            lost = outbox.lost_share(now_s)
            if lost is not None:
                self._report(StreamPaced(name, lost))

    def _stream_of(self, client: str) -> list[tuple[str, StreamOutbox]]:
        outbox = self._streams.get(client)
        return [] if outbox is None else [(client, outbox)]

    async def _check_request(self, connection: ServerConnection, request: Request) -> Response | None:
        path = urlsplit(request.path).path
        refusal = self._admission.judge(request, reads_health=path == "/health")
        if refusal is not None:
            return connection.respond(*refusal)
        if (page := {"/health": self._health, "/metrics": self._metrics}.get(path)) is not None:
            return page(connection)
        if is_recording(path) and self.recordings is not None:
            return await self.recordings.respond(path, request)
        if path not in {"/control", "/stream", "/watch"}:
            return connection.respond(
                HTTPStatus.NOT_FOUND, "There are /control, /stream, /watch, /health and /metrics.\n"
            )
        if path == "/control" and len(self._controls) >= MAX_CLIENTS:
            return connection.respond(HTTPStatus.SERVICE_UNAVAILABLE, "There are too many clients.\n")
        return None

    def _health(self, connection: ServerConnection) -> Response:
        body = {
            "status": "ok",
            "state": self._session.state.value,
            "clients": len(self._controls),
            "streams": len(self._streams),
            "tick": self._session.mirror.tick,
        }
        response = connection.respond(HTTPStatus.OK, _encode(body).decode() + "\n")
        del response.headers["Content-Type"]
        response.headers["Content-Type"] = "application/json"
        return response

    def _metrics(self, connection: ServerConnection) -> Response:
        # Prometheus' client takes 60 ms to import, for which no start of a session should wait.
        from executor.manager.metrics import CONTENT_TYPE, metrics_text  # noqa: PLC0415

        self.traffic.clients, self.traffic.streams = len(self._controls), len(self._streams)
        response = connection.respond(HTTPStatus.OK, metrics_text(self._session, self.traffic))
        del response.headers["Content-Type"]
        response.headers["Content-Type"] = CONTENT_TYPE
        return response

    async def _serve(self, connection: ServerConnection) -> None:
        assert connection.request is not None  # noqa: S101 - the handshake is over
        url = urlsplit(connection.request.path)
        asked = parse_qs(url.query).get("client", [None])[0]
        user = user_of(connection.request.headers.get(USER_HEADER))
        _read_little(connection)
        with contextlib.suppress(ConnectionClosed):
            if url.path == "/control":
                await self._serve_control(connection, asked, user)
            elif url.path == "/stream":
                await self._serve_stream(connection, asked)
            else:
                await _take_nothing(connection)

    async def _serve_control(self, connection: ServerConnection, asked: str | None, user: str | None) -> None:
        client = self._session.clients.client_id(asked)
        if client in self._controls:
            self._dismiss(client)
        outbox = self._controls[client] = ControlOutbox(lambda: self._snapshot_message(client))
        self._connections[client] = connection
        self._report(ClientJoined(client, user))
        sender = asyncio.create_task(_send_all(connection, outbox))
        try:
            await self._take_all(client, connection, outbox)
        finally:
            sender.cancel()
            if self._controls.get(client) is outbox:
                self._forget(client)

    def _forget(self, client: str) -> None:
        del self._controls[client], self._connections[client]
        self._report(ClientLeft(client))

    def _dismiss(self, client: str) -> None:
        """Closes the old connection of a client that has connected again."""
        self._close_soon(self._connections[client])
        self._forget(client)

    def _close_soon(self, connection: ServerConnection) -> None:
        closing = asyncio.create_task(connection.close(REPLACED, "this page has opened another connection"))
        self._closing.add(closing)
        closing.add_done_callback(self._closing.discard)

    async def _serve_stream(self, connection: ServerConnection, client: str | None) -> None:
        if client is None or client not in self._controls:
            await connection.close(4404, "open /control first and name its client_id")
            return
        if (lost := self._stream_connections.get(client)) is not None:
            self._close_soon(lost)  # a client opens a second socket only after it has lost the first
        self._stream_connections[client] = connection
        outbox = self._streams[client] = StreamOutbox()
        self._report(StreamOpened(client))
        sender = asyncio.create_task(_send_all(connection, outbox))
        try:
            await _take_nothing(connection)
        finally:
            sender.cancel()
            if self._streams.get(client) is outbox:
                del self._streams[client], self._stream_connections[client]
                self._report(StreamClosed(client))

    async def _take_all(self, client: str, connection: ServerConnection, outbox: ControlOutbox) -> None:
        """Handles commands in small groups; waits while too many of the client's replies are unread."""
        allowance = Allowance(time.monotonic())
        taken = 0
        async for frame in connection:
            self._take(client, frame, allowance)
            taken += 1
            if taken % COMMANDS_IN_TURN == 0:
                await asyncio.sleep(0)
                await outbox.has_room()

    def _take(self, client: str, frame: str | bytes, allowance: Allowance) -> None:
        request = ""
        self.traffic.commands += 1
        try:
            if isinstance(frame, bytes):
                raise msgspec.DecodeError("commands are text frames")
            message = msgspec.json.decode(frame, type=ClientMessage)
            request = message.id
            wait_s = allowance.take(message.command, time.monotonic())
            if wait_s > 0:
                self._refuse(client, request, "too_fast", *_slow_down(allowance, wait_s))
                return
            kind = COMMANDS.get(message.command)
            if kind is None:
                self._refuse(client, request, "unknown_command", f"There is no command {message.command!r}.")
                return
            data = _decode_data(message.data, kind)
        except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
            code = "bad_data" if request else "bad_frame"
            self._refuse(client, request, code, f"The command is refused: {error}.")
            return
        self._report(CommandCame(client, request, message.command, data))

    def _refuse(self, client: str, request: str, code: str, text: str, hint: str = "") -> None:
        self.traffic.refusals += 1
        self._queue(client, "error", msgspec.Raw(_encode(Error(code, text, hint))), request)

    def _queue(self, client: str, name: str, payload: msgspec.Raw, request: str | None) -> None:
        outbox = self._controls.get(client)
        if outbox is not None:
            outbox.put(self._envelope(name, payload, request), is_reply=request is not None)

    def _envelope(self, name: str, payload: msgspec.Raw, request: str | None) -> bytes:
        self._seq += 1
        message = ServerMessage(
            id=f"e{self._seq}" if request is None else request,
            command=name,
            data=payload,
            seq=self._seq,
            t=self._session.sim_time_s,
            tick=self._session.mirror.tick or UNSET,
        )
        return _encode(message)

    def _snapshot_message(self, client: str) -> bytes:
        self.traffic.snapshots += 1
        _log.info("client %s is too slow and gets a snapshot", client)
        return self._envelope("snapshot", msgspec.Raw(_encode(self._session.snapshot())), None)


def _decode_data(data: msgspec.Raw, kind: type[Struct]) -> Struct:
    if bytes(data).strip() == b"null":
        data = msgspec.Raw(b"{}")
    if kind is Empty:
        # Older clients send data with these commands; it is ignored.
        return Empty()
    return msgspec.json.decode(data, type=kind)


def _slow_down(allowance: Allowance, wait_s: float) -> tuple[str, str]:
    text = f"This page sends more commands than a session takes: {allowance.rate_hz:g} a second."
    return text, f"Wait {max(wait_s, 0.1):.1f} s, then send it again."


def _read_little(connection: ServerConnection) -> None:
    """Limits how many bytes asyncio reads in one step; its default is 256 KiB."""
    transport: Any = connection.transport
    transport.max_size = READ_BYTES


async def _take_nothing(connection: ServerConnection) -> None:
    """Waits until a client disconnects; answers each of its messages with an error."""
    async for _ in connection:
        await connection.close(UNEXPECTED, "commands are sent on /control")


async def _send_all(connection: ServerConnection, outbox: ControlOutbox | StreamOutbox) -> None:
    is_text = isinstance(outbox, ControlOutbox)
    sent = 0
    with contextlib.suppress(ConnectionClosed):
        while True:
            data = await outbox.take()
            await connection.send(data, text=is_text)
            sent += 1
            if sent % MESSAGES_IN_TURN == 0:
                await asyncio.sleep(0)
