"""The time in which a page waits for a place of a language server.

The page gets `bt/place` with the number of those before it, each time that it changes; null when it has one.
"""

from __future__ import annotations

import asyncio
import json
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import environment
from backend.core.processes.fair_places import Share, editors

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable

    from backend.accounts.models import User
    from backend.core.processes.fair_places import Ticket, Turn

METHOD: Final = "bt/place"
POLL_S: Final = 1.0
MOST_EARLY: Final = 8
"""Messages that are kept for the server while the page waits."""


def enter(user: User) -> Ticket | None:
    """Returns the ticket of a page of a user; None if so many of theirs wait already."""
    limits = environment()
    share = Share(
        limits.max_language_servers,
        limits.of_one_user(limits.max_user_language_servers),
        limits.of_one_user(limits.max_user_waiting),
    )
    return editors.enter(str(user.pk), share, is_exempt=user.is_exempt)


@asynccontextmanager
async def placed(
    ticket: Ticket, receive: ASGIReceiveCallable, send: ASGISendCallable
) -> AsyncIterator[ASGIReceiveCallable | None]:
    """Waits until the page has a place; gives the rest of its messages, or None if it has left."""
    if ticket.turn() is None:
        await _tell(send, None)
        yield receive
        return
    early: list[Any] = []
    pending = [asyncio.ensure_future(receive())]
    try:
        told: Turn | None = None
        while (turn := ticket.turn()) is not None:
            if turn != told:
                await _tell(send, turn)
            told = turn
            await asyncio.wait(pending, timeout=POLL_S)
            if pending[0].done():
                early.append(pending[0].result())
                if early[-1]["type"] == "websocket.disconnect" or len(early) > MOST_EARLY:
                    yield None
                    return
                pending[0] = asyncio.ensure_future(receive())
        await _tell(send, None)

        async def rest() -> Any:
            if early:
                return early.pop(0)
            if not pending:
                return await receive()
            message = await pending[0]
            pending.clear()
            return message

        yield rest
    finally:
        for task in pending:
            task.cancel()
        await asyncio.gather(*pending, return_exceptions=True)


async def _tell(send: ASGISendCallable, turn: Turn | None) -> None:
    params = {"before": None, "is_own": False} if turn is None else turn._asdict()
    text = json.dumps({"jsonrpc": "2.0", "method": METHOD, "params": params})
    await send({"type": "websocket.send", "text": text, "bytes": None})
