"""Tasks end, also those that lose a cancellation."""

from __future__ import annotations

import asyncio
from contextlib import suppress

from backend.core import tasks
from backend.core.tasks import ended


async def test_a_task_that_loses_cancellations_is_cancelled_again(monkeypatch):
    monkeypatch.setattr(tasks, "AGAIN_S", 0.01)
    lost = []

    async def deaf():
        for _ in range(2):
            with suppress(asyncio.CancelledError):
                await asyncio.Event().wait()
            lost.append(True)
        await asyncio.Event().wait()

    async def failing():
        raise ValueError

    async def done():
        return 1

    all_of_them = [asyncio.create_task(one()) for one in (deaf, failing, done)]
    await asyncio.sleep(0)
    await ended(*all_of_them)
    assert lost == [True, True]
    assert [task.done() for task in all_of_them] == [True] * 3
    await ended()
