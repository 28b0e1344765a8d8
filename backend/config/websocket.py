"""The server's end of a browser's websocket."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

if TYPE_CHECKING:
    from asyncio import BaseTransport

READ_BYTES: Final = 4 << 10


def read_little(transport: Any) -> None:
    """Has asyncio hand on less at a time than the 256 KiB that it is used to."""
    transport.max_size = READ_BYTES


class PatientSocket(WebSocketsSansIOProtocol):
    """Reads little at a time.

    All frames in what is read are parsed at once. In the 256 KiB that asyncio reads there can be thousands,
    for which every other socket would wait.
    """

    def connection_made(self, transport: BaseTransport) -> None:
        """Called by uvicorn."""
        read_little(transport)
        super().connection_made(transport)
