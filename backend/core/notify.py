"""Notices over the channel layer: sent from any thread without waiting for their delivery, and followed."""

from __future__ import annotations

import asyncio
import logging
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass
from secrets import token_hex
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, TypeVar

from asgiref.sync import async_to_sync
from channels.layers import get_channel_layer

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable, Mapping

log = logging.getLogger(__name__)
Result = TypeVar("Result")


ANSWER_S: Final = 5.0
PAUSE_S: Final = 5.0
"""How long nobody asks Redis after it did not answer, so that sockets do not each wait for it."""


@dataclass
class _Away:
    """Up to when Redis counts as away, by `time.monotonic`."""

    until_s: float = 0.0


_away: Final = _Away()


class NoNoticesError(Exception):
    """Raised when Redis does not answer, so that notices cannot be followed."""


@asynccontextmanager
async def following(group: str) -> AsyncIterator[Callable[[], Awaitable[dict[str, Any]]]]:
    """Yields a function that waits for the next notice to a group.

    Raises:
        NoNoticesError: Redis does not answer.
    """
    layer = get_channel_layer()
    if monotonic() < _away.until_s:
        raise NoNoticesError("notices cannot be followed: Redis did not answer a moment ago")
    prefix = f"specific.{token_hex(8)}."
    try:
        async with asyncio.timeout(ANSWER_S):
            channel = await _tried_again(lambda: layer.new_channel(prefix))
            await _tried_again(lambda: layer.group_add(group, channel))
    except BaseException as error:
        await _forget(layer, group, prefix)
        if not isinstance(error, Exception):
            raise  # the socket was closed meanwhile
        _away.until_s = monotonic() + PAUSE_S
        raise NoNoticesError(f"notices cannot be followed: {error!r}") from error
    try:
        yield lambda: layer.receive(channel)
    finally:
        try:
            await layer.group_discard(group, channel)
        except Exception as error:  # the socket ends in any case
            log.warning("a channel was not left: %s", error)


async def _forget(layer: Any, group: str, prefix: str) -> None:
    """Removes the channels of a try that failed: the layer keeps them, also where Redis did not take them."""
    for channel in [name for name in layer.channels if prefix in name]:
        with suppress(Exception):
            async with asyncio.timeout(ANSWER_S):
                await layer.group_discard(group, channel)
        layer.channels.pop(channel, None)


async def _tried_again(ask: Callable[[], Awaitable[Result]]) -> Result:
    """Asks Redis, and asks once more: after its restart the first one finds a lost connection."""
    try:
        return await ask()
    except Exception:  # the second failure is raised
        return await ask()


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
        except Exception as error:  # whatever the channel layer raises
            # A lost notice does no harm: the change that it announces is stored. While Redis is away each
            # save comes here, so this is one line.
            log.warning("a notice was not sent: %s", error)


_teller = _Teller()
serve, tell = _teller.serve, _teller.tell
