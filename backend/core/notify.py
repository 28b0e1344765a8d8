"""Sends notices over the channel layer from any thread, without waiting for their delivery."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING, Any

from asgiref.sync import async_to_sync
from channels.layers import get_channel_layer

if TYPE_CHECKING:
    from collections.abc import Mapping

log = logging.getLogger(__name__)


class _Teller:
    """Sends notices in the event loop of the server, in which the sockets wait for them."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._sending: set[asyncio.Task[None]] = set()

    def serve(self, loop: asyncio.AbstractEventLoop | None) -> None:
        """Sets the loop that sends notices; without a loop, the calling thread sends them."""
        self._loop = loop

    def tell(self, group: str, notice: Mapping[str, Any]) -> None:
        """Sends a notice to all members of a group."""
        if self._loop is None:
            async_to_sync(get_channel_layer().group_send)(group, notice)
        else:
            self._loop.call_soon_threadsafe(self._begin, group, notice)

    def _begin(self, group: str, notice: Mapping[str, Any]) -> None:
        task = asyncio.get_running_loop().create_task(self._send(group, notice))
        self._sending.add(task)  # the loop has only weak references to its tasks
        task.add_done_callback(self._sending.discard)

    async def _send(self, group: str, notice: Mapping[str, Any]) -> None:
        try:
            await get_channel_layer().group_send(group, notice)
        except Exception:
            # A lost notice does no harm: the change that it announces is stored.
            log.exception("a notice was not sent")


_teller = _Teller()
serve, tell = _teller.serve, _teller.tell
