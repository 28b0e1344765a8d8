"""The server's end of a browser's websocket."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from backend.core.connection_costs import COSTS, ConnectionCosts

if TYPE_CHECKING:
    from asyncio import BaseTransport, TimerHandle

    from uvicorn._types import ASGISendEvent
    from websockets.frames import Frame
    from websockets.http11 import Request

READ_BYTES: Final = 4 << 10
"""Bytes of one read from an accepted client."""
READ_LITTLE_BYTES: Final = 1 << 10
"""Bytes of one read from a client who is not accepted yet, or who may not send."""
LARGEST_MESSAGE: Final = 64 << 20
SMALL_BYTES: Final = 4 << 10
"""The largest message, in bytes, from a client who is not accepted yet, or who may not send."""
MOST_BYTES: Final = "bt_studio.most_bytes"
"""The key of the largest message in bytes, in the ASGI message that accepts a socket."""
IDLE_FRAMES: Final = 100
"""Frames without content that a client may send in a second: pings, pongs, and tiny parts of a message."""
TINY: Final = 256
POLICY_VIOLATION: Final = 1008
TOO_BIG: Final = 1009


def read_at_most(transport: Any, size: int) -> None:
    """Limits how many bytes asyncio reads in one step; its default is 256 KiB."""
    transport.max_size = size


class PatientSocket(WebSocketsSansIOProtocol):
    """uvicorn's websocket with small reads, pauses for owners over their share, and a limit of empty frames.

    All frames of one read are parsed in one step. The 256 KiB that asyncio reads by default can contain
    thousands of them, and all other sockets would wait meanwhile.
    """

    _is_resting = False
    _has_backlog = False

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._idle_frames, self._since = 0, 0.0
        self._rest: TimerHandle | None = None
        self._costs = ConnectionCosts(None)

    @property
    def read_paused(self) -> bool:
        """The flag of uvicorn by which reading is paused.

        uvicorn resumes reading when the application took a message, but not during a pause.
        """
        return self._has_backlog and not self._is_resting

    @read_paused.setter
    def read_paused(self, value: bool) -> None:
        self._has_backlog = value

    def connection_made(self, transport: BaseTransport) -> None:
        """Starts the limits of a new connection; called by uvicorn."""
        read_at_most(transport, READ_LITTLE_BYTES)
        super().connection_made(transport)
        self._costs = ConnectionCosts(self.client[0] if self.client else None)

    def connection_lost(self, exc: Exception | None) -> None:
        """Cancels a pause; called by asyncio."""
        if self._rest is not None:
            self._rest.cancel()
        self._costs.release()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Processes received bytes, and charges their processor time to the owner; called by asyncio."""
        if not self._costs.hold(len(data)) and self.handshake_complete and not self.close_sent:
            self.conn.fail(TOO_BIG, "too many large messages at once")
            self.handle_parser_exception()
            return
        with self._costs.booked():
            super().data_received(data)
        if (rest_s := self._costs.rest_s()) and not self.transport.is_closing():
            self._is_resting = True
            self.transport.pause_reading()
            self._rest = self.loop.call_later(rest_s, self._end_rest)

    def _end_rest(self) -> None:
        self._is_resting = False
        if not (self._has_backlog and not self.queue.empty()):
            self._has_backlog = False
            self.transport.resume_reading()

    def handle_connect(self, event: Request) -> None:
        """Limits messages to `SMALL_BYTES` until the client is identified."""
        self.conn.max_message_size = SMALL_BYTES
        super().handle_connect(event)
        if self.handshake_initiated and not self.handshake_complete:
            self.scope[COSTS] = self._costs  # type: ignore[typeddict-unknown-key]

    def send_receive_event_to_app(self) -> None:
        """Passes a complete message to the application; called by uvicorn."""
        self._costs.release()
        super().send_receive_event_to_app()

    async def send(self, message: ASGISendEvent) -> None:
        """Sends a message of the application.

        The message that accepts the socket sets its largest message.
        """
        if message["type"] == "websocket.accept":
            most: Any = message.get(MOST_BYTES, self.config.ws_max_size)
            self.conn.max_message_size = most
            if most > SMALL_BYTES:
                read_at_most(self.transport, READ_BYTES)
        await super().send(message)

    def handle_ping(self) -> None:
        """Answers a ping with a pong, unless the client does not read.

        Unread pongs would accumulate without limit.
        """
        if not self._is_too_idle():
            if self.writable.is_set():
                super().handle_ping()
            else:
                self.conn.data_to_send()

    def handle_pong(self, event: Frame) -> None:
        """Counts the frame, since clients can send pongs that were not requested."""
        if not self._is_too_idle():
            super().handle_pong(event)

    def handle_cont(self, event: Frame) -> None:
        """Counts parts of a message that are unnecessarily small."""
        if len(event.data) >= TINY or event.fin or not self._is_too_idle():
            super().handle_cont(event)

    def _is_too_idle(self) -> bool:
        """Returns whether too many frames without content arrived; the socket is then closed."""
        now = self.loop.time()
        if now - self._since > 1:
            self._idle_frames, self._since = 0, now
        self._idle_frames += 1
        if self._idle_frames <= IDLE_FRAMES:
            return False
        if self._idle_frames == IDLE_FRAMES + 1 and not self.close_sent:
            self.conn.fail(POLICY_VIOLATION, "too many frames")
            self.handle_parser_exception()
        return True
