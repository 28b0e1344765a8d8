"""Sends notices over the channel layer from whatever thread; nobody waits for them to arrive."""

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
    """Knows the event loop of the server, in which its sockets wait for notices."""

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._sending: set[asyncio.Task[None]] = set()

    def serve(self, loop: asyncio.AbstractEventLoop | None) -> None:
        """From now on notices are sent from this loop; without one, by the thread that tells them."""
        self._loop = loop

    def tell(self, group: str, notice: Mapping[str, Any]) -> None:
        """Sends a notice to all in a group."""
        if self._loop is None:
            async_to_sync(get_channel_layer().group_send)(group, notice)
        else:
            self._loop.call_soon_threadsafe(self._begin, group, notice)

    def _begin(self, group: str, notice: Mapping[str, Any]) -> None:
        task = asyncio.get_running_loop().create_task(self._send(group, notice))
        self._sending.add(task)  # a loop holds its tasks weakly
        task.add_done_callback(self._sending.discard)

    async def _send(self, group: str, notice: Mapping[str, Any]) -> None:
        try:
            await get_channel_layer().group_send(group, notice)
        except Exception:
            # A lost notice does no harm: what it tells of is stored.
            log.exception("a notice was not sent")


_teller = _Teller()
serve, tell = _teller.serve, _teller.tell
