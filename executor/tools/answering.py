"""Work for a client that ends when the client leaves."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Coroutine
    from typing import Any

    from websockets.asyncio.server import ServerConnection

__all__ = ["answer"]


async def answer(connection: ServerConnection, made: Coroutine[Any, Any, str]) -> None:
    """Sends what the work returns; the work is cancelled if the connection ends before."""
    work = asyncio.create_task(made)
    left = asyncio.create_task(connection.wait_closed())
    try:
        await asyncio.wait({work, left}, return_when=asyncio.FIRST_COMPLETED)
        if work.done():
            await connection.send(work.result())
    finally:
        for task in (work, left):
            task.cancel()
        await asyncio.gather(work, left, return_exceptions=True)
