"""The server's end of a browser's websocket."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

if TYPE_CHECKING:
    from asyncio import BaseTransport

    from uvicorn._types import ASGISendEvent
    from websockets.frames import Frame
    from websockets.http11 import Request

READ_BYTES: Final = 4 << 10
LARGEST_MESSAGE: Final = 64 << 20
SMALL_BYTES: Final = 4 << 10
"""The largest message from a client who is not accepted yet, or who has nothing to say."""
MOST_BYTES: Final = "bt_studio.most_bytes"
"""What the largest message may be, where the message that accepts a socket says it."""
IDLE_FRAMES: Final = 100
"""Frames a second that may come and say nothing: pings, pongs, and tiny parts of a message."""
TINY: Final = 256
POLICY_VIOLATION: Final = 1008


def read_little(transport: Any) -> None:
    """Makes asyncio read less at a time than its usual 256 KiB."""
    transport.max_size = READ_BYTES


class PatientSocket(WebSocketsSansIOProtocol):
    """Reads little at a time, and bounds what costs its client nothing.

    All frames in what is read are parsed at once. In the 256 KiB that asyncio reads there can be thousands,
    for which every other socket would wait.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._idle_frames, self._since = 0, 0.0

    def connection_made(self, transport: BaseTransport) -> None:
        """Called by uvicorn."""
        read_little(transport)
        super().connection_made(transport)

    def handle_connect(self, event: Request) -> None:
        """A client who is not known yet sends little."""
        self.conn.max_message_size = SMALL_BYTES
        super().handle_connect(event)

    async def send(self, message: ASGISendEvent) -> None:
        """An accepted one sends what its route takes."""
        if message["type"] == "websocket.accept":
            most: Any = message.get(MOST_BYTES, self.config.ws_max_size)
            self.conn.max_message_size = most
        await super().send(message)

    def handle_ping(self) -> None:
        """Answers; a client who reads no pongs is sent none, since nothing else bounds them."""
        if not self._is_too_idle():
            if self.writable.is_set():
                super().handle_ping()
            else:
                self.conn.data_to_send()

    def handle_pong(self, event: Frame) -> None:
        """Counts, for anybody may send pongs that nobody waits for."""
        if not self._is_too_idle():
            super().handle_pong(event)

    def handle_cont(self, event: Frame) -> None:
        """Counts the parts that a message was not cut into for its size."""
        if len(event.data) >= TINY or event.fin or not self._is_too_idle():
            super().handle_cont(event)

    def _is_too_idle(self) -> bool:
        """Whether more comes that says nothing than may; the socket is then closed."""
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
