"""Ends tasks of the event loop."""

from __future__ import annotations

import asyncio
from typing import Any, Final

AGAIN_S: Final = 1.0


async def ended(*tasks: asyncio.Future[Any]) -> None:
    """Cancels tasks until they have ended; their results are not raised.

    A task can lose a cancellation: `asyncio.wait_for` does if what it waits for ends at the same moment, and
    libraries catch it. Such a task would continue until its own time is over.
    """
    left = set(tasks)
    while left:
        for task in left:
            task.cancel()
        _, left = await asyncio.wait(left, timeout=AGAIN_S)
    await asyncio.gather(*tasks, return_exceptions=True)
