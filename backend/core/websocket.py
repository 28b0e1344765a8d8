"""The server's end of a browser's websocket."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from backend.core.connection_costs import COSTS, ConnectionCosts

if TYPE_CHECKING:
    from asyncio import BaseTransport, TimerHandle

    from uvicorn._types import ASGIReceiveEvent, ASGISendEvent
    from websockets.frames import Frame
    from websockets.http11 import Request

READ_BYTES: Final = 4 << 10
"""Bytes of one read from an accepted client."""
READ_LITTLE_BYTES: Final = 1 << 10
"""Bytes of one read from a client who is not accepted yet, or who may not send."""
SMALL_BYTES: Final = 4 << 10
"""The largest message, in bytes, from a client who is not accepted yet, or who may not send."""
MOST_BYTES: Final = "bt_studio.most_bytes"
"""The key of the largest message in bytes, in the ASGI message that accepts a socket."""
AS_BYTES: Final = "bt_studio.as_bytes"
"""The key of whether texts come as bytes, in the ASGI message that accepts a socket: they are passed on."""
IS_TEXT: Final = "bt_studio.is_text"
"""The key of whether the bytes of an ASGI message are such a text."""
IDLE_FRAMES: Final = 100
"""Frames without content that a client may send in a second: pings, pongs, and tiny parts of a message."""
TINY: Final = 256
PATIENCE_S: Final = 30.0
SLOWEST: Final = 8 * 1024
"""Bytes per second of an unfinished message; the socket is closed after `PATIENCE_S` of less than that."""
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
    _as_bytes = False

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._idle_frames, self._since = 0, 0.0
        self._rest: TimerHandle | None = None
        self._costs = ConnectionCosts(None)
        self._window: TimerHandle | None = None
        self._stopped_s = 0.0

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
        self._end_window()
        self._costs.release()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Processes received bytes, and charges their processor time to the owner; called by asyncio."""
        if not self._costs.hold(len(data)) and self.handshake_complete and not self.close_sent:
            self.conn.fail(TOO_BIG, "Too many large messages are on their way. Try again in a moment.")
            self.handle_parser_exception()
            return
        with self._costs.booked():
            super().data_received(data)
        if not (self.frames or self.conn.reader.buffer):
            self._costs.nothing_arrives()
            self._end_window()
        elif self._window is None and self._costs.is_counted and not self.close_sent:
            self._begin_window()
        if (rest_s := self._costs.rest_s()) and not self.transport.is_closing():
            self._is_resting = True
            self._stopped_s += rest_s
            self.transport.pause_reading()
            self._rest = self.loop.call_later(rest_s, self._end_rest)

    def _end_rest(self) -> None:
        self._is_resting = False
        if not (self._has_backlog and not self.queue.empty()):
            self._has_backlog = False
            self.transport.resume_reading()

    def _unfinished_bytes(self) -> int:
        """Returns how much of the message is here; pings between its parts do not count."""
        return sum(map(len, self.frames)) + len(self.conn.reader.buffer)

    def _begin_window(self) -> None:
        """Begins a time in which a part of the unfinished message must arrive."""
        self._stopped_s = 0.0 if self.transport.is_reading() else PATIENCE_S
        self._window = self.loop.call_later(PATIENCE_S, self._look_at_pace, self._unfinished_bytes())

    def _end_window(self) -> None:
        if self._window is not None:
            self._window.cancel()
            self._window = None

    def _look_at_pace(self, before: int) -> None:
        """Closes the socket if its message came too slowly, but not for the time in which it was not read."""
        self._window = None
        if self.close_sent or self.transport.is_closing():
            return
        if self._unfinished_bytes() - before >= PATIENCE_S * SLOWEST:
            self._begin_window()
        elif self._stopped_s:
            self._window = self.loop.call_later(self._stopped_s, self._look_at_pace, before)
            self._stopped_s = 0.0 if self.transport.is_reading() else PATIENCE_S
        else:
            self.conn.fail(POLICY_VIOLATION, "The message came too slowly, or not to its end.")
            self.handle_parser_exception()

    def handle_connect(self, event: Request) -> None:
        """Limits messages to `SMALL_BYTES` until the client is identified."""
        self.conn.max_message_size = SMALL_BYTES
        super().handle_connect(event)
        if self.handshake_initiated and not self.handshake_complete:
            self.scope[COSTS] = self._costs  # type: ignore[typeddict-unknown-key]

    def send_receive_event_to_app(self) -> None:
        """Passes a complete message to the application; called by uvicorn."""
        if self.close_sent:
            self._costs.release()
            super().send_receive_event_to_app()
            return
        self._costs.complete()
        self._end_window()
        if not self._as_bytes or self.curr_msg_data_type != "text":
            super().send_receive_event_to_app()
            return
        # A text of 64 MB could take 256 MB if it were decoded.
        message: Any = {"type": "websocket.receive", "bytes": b"".join(self.frames), IS_TEXT: True}
        self.frames = []
        self.queue.put_nowait(message)
        if not self.read_paused:
            self.read_paused = True
            self.transport.pause_reading()

    async def receive(self) -> ASGIReceiveEvent:
        """Returns the next message to the application, which has passed on the one before."""
        self._costs.passed_on()
        message = await super().receive()
        if message["type"] == "websocket.receive":
            self._costs.taken()
        return message

    async def send(self, message: ASGISendEvent) -> None:
        """Sends a message of the application.

        The message that accepts the socket sets its largest message.
        """
        if message["type"] == "websocket.accept":
            most: Any = message.get(MOST_BYTES, self.config.ws_max_size)
            self.conn.max_message_size = most
            self._as_bytes = bool(message.get(AS_BYTES))
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
