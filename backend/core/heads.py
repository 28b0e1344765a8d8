"""Bounds what a connection may cost before its request is known: the time and the size of a request's head.

uvicorn waits without end for a head that comes byte by byte, and keeps all of it in memory.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from backend.core.problems import MEDIA_TYPE, problem
from backend.core.websocket import read_at_most

if TYPE_CHECKING:
    import asyncio

HEAD_S: Final = 15.0
"""From the beginning of a connection, or of its next request, to the end of the head."""
HEAD_BYTES: Final = 64 * 1024
READ_HEAD_BYTES: Final = 8 * 1024
"""Read at a time of a head, each line of which is a call: thousands fit into the 256 KiB of asyncio."""
READ_BODY_BYTES: Final = 256 * 1024


class PatientProtocol(HttpToolsProtocol):
    """uvicorn's protocol, whose patience has an end."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._head_timer: asyncio.TimerHandle | None = None
        self._head_bytes = 0
        self._in_head = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begins to wait for the first head."""
        super().connection_made(transport)
        read_at_most(transport, READ_HEAD_BYTES)
        self._wait_for_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """Waits no longer."""
        self._stop_waiting()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Counts what comes outside of bodies; between two requests that may be empty lines without end."""
        before = self._in_head or self._is_idle()
        super().data_received(data)
        if self.transport.is_closing() or self.transport.get_protocol() is not self:
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
        """A head begins."""
        super().on_message_begin()
        self._in_head = True

    def on_headers_complete(self) -> None:
        """It is whole."""
        self._in_head, self._head_bytes = False, 0
        self._stop_waiting()
        read_at_most(self.transport, READ_BODY_BYTES)
        super().on_headers_complete()

    def on_message_complete(self) -> None:
        """The next thing that comes is a head."""
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
