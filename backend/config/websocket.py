"""The server's end of a browser's websocket."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

if TYPE_CHECKING:
    from asyncio import BaseTransport

READ_BYTES: Final = 8 << 10


class PatientSocket(WebSocketsSansIOProtocol):
    """Reads little at a time.

    All frames in what is read are parsed at once. In the 256 KiB that asyncio reads there can be thousands,
    for which every other socket would wait.
    """

    def connection_made(self, transport: BaseTransport) -> None:
        """Called by uvicorn."""
        sized: Any = transport
        sized.max_size = READ_BYTES
        super().connection_made(transport)
