"""Limits the time and the size of a request's head.

The head is the cost of a connection before its request is known.

uvicorn itself waits without limit for a head that arrives byte by byte, and keeps all of it in memory.
Reading pauses on connections of an owner who exceeded their share of the event loop.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from backend.core.connection_costs import ABORT, COSTS, ConnectionCosts
from backend.core.problems import MEDIA_TYPE, problem
from backend.core.websocket import read_at_most

if TYPE_CHECKING:
    import asyncio

CONNECTION_S: Final = 0.0005
"""Event-loop time in seconds to open and close a connection, as measured."""
HEAD_S: Final = 15.0
"""Seconds from the start of a connection, or of its next request, to the end of the head."""
HEAD_BYTES: Final = 64 * 1024
READ_HEAD_BYTES: Final = 8 * 1024
"""Bytes of one read, until the head is complete.

Each header line costs one Python call, and thousands of them fit into the 256 KiB that asyncio reads by
default.
"""
READ_BODY_BYTES: Final = 256 * 1024


class PatientProtocol(HttpToolsProtocol):
    """uvicorn's protocol with a limit of time and size for each head."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._head_timer: asyncio.TimerHandle | None = None
        self._head_bytes = 0
        self._in_head = False
        self._costs = ConnectionCosts(None)
        self._rest: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Starts the timeout of the first head."""
        super().connection_made(transport)
        self._costs = ConnectionCosts(self.client[0] if self.client else None)
        read_at_most(transport, READ_HEAD_BYTES)
        self._wait_for_head()
        self._costs.spend(CONNECTION_S)
        self._rest_if_due()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stops the timeout."""
        self._stop_waiting()
        if self._rest is not None:
            self._rest.cancel()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Processes received bytes, and charges their processor time to the owner."""
        with self._costs.booked():
            self._received(data)
        self._rest_if_due()

    def _rest_if_due(self) -> None:
        """Pauses reading if the owner has exceeded their share."""
        if self._is_ours() and (rest_s := self._costs.rest_s()):
            self.transport.pause_reading()
            if self._rest is not None:
                self._rest.cancel()
            self._rest = self.loop.call_later(rest_s, self._end_rest)

    def _end_rest(self) -> None:
        if self._is_ours() and not self.flow.read_paused:
            self.transport.resume_reading()

    def _is_ours(self) -> bool:
        """Returns whether this protocol still owns the connection: open, not taken over by a websocket."""
        return not self.transport.is_closing() and self.transport.get_protocol() is self

    def _received(self, data: bytes) -> None:
        """Counts bytes outside of bodies.

        Otherwise a client could send empty lines without end between requests.
        """
        before = self._in_head or self._is_idle()
        super().data_received(data)
        if not self._is_ours():
            self._stop_waiting()
            return
        if not (self._in_head or self._is_idle()):
            return
        self._head_bytes += len(data) if before else 0
        if self._head_bytes > HEAD_BYTES:
            sentence = f"The head of a request may have at most {HEAD_BYTES:,} bytes."
            self._refuse(431, "head_too_large", sentence)
        elif self._head_timer is None:
            self._wait_for_head()

    def on_message_begin(self) -> None:
        """Notes that a head begins."""
        super().on_message_begin()
        self._in_head = True

    def on_headers_complete(self) -> None:
        """Stops the timeout and reads larger parts: the head is complete."""
        self._in_head, self._head_bytes = False, 0
        self._stop_waiting()
        read_at_most(self.transport, READ_BODY_BYTES)
        super().on_headers_complete()
        self.scope[COSTS] = self._costs  # type: ignore[typeddict-unknown-key]
        self.scope[ABORT] = self.transport.abort  # type: ignore[typeddict-unknown-key]

    def on_message_complete(self) -> None:
        """Reads small parts again: the next bytes are a head."""
        read_at_most(self.transport, READ_HEAD_BYTES)
        super().on_message_complete()

    def _is_idle(self) -> bool:
        return self.cycle is None or self.cycle.response_complete

    def _wait_for_head(self) -> None:
        self._head_timer = self.loop.call_later(HEAD_S, self._give_up)

    def _stop_waiting(self) -> None:
        if self._head_timer is not None:
            self._head_timer.cancel()
            self._head_timer = None

    def _give_up(self) -> None:
        self._head_timer = None
        if self._in_head:
            self._refuse(408, "request_too_slow", "The head of the request came too slowly.")
        elif self._is_idle():
            # Closing would wait until the client has read the end of its last answer.
            if self.transport.get_write_buffer_size():
                self.transport.abort()
            self.transport.close()

    def _refuse(self, status: int, code: str, sentence: str) -> None:
        self._stop_waiting()
        if self.transport.is_closing():
            return
        document = problem(status, code, detail=sentence)
        body = json.dumps(document).encode()
        head = (
            f"HTTP/1.1 {status} {document['title']}\r\ncontent-type: {MEDIA_TYPE}\r\n"
            f"content-length: {len(body)}\r\nconnection: close\r\n\r\n"
        )
        self.transport.write(head.encode() + body)
        self.transport.close()
