"""Work for a client of the tools."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import psutil

from executor.tools.answering import answer
from tests.deadline import wait_until
from tests.executor.tools.test_behaviours import asked
from tests.executor.tools.test_server import client, tools


class Client:
    """A client that leaves when it may."""

    def __init__(self):
        self.leaves, self.heard = asyncio.Event(), []

    async def wait_closed(self):
        await self.leaves.wait()

    async def send(self, text):
        self.heard.append(text)


async def made(text, *, after=None):
    await (after or asyncio.Event()).wait()
    return text


async def test_the_answer_is_sent_or_the_work_ends_with_the_client():
    there: Any = Client()
    ready = asyncio.Event()
    ready.set()
    await answer(there, made("done", after=ready))
    assert there.heard == ["done"]
    there.leaves.set()
    await answer(there, made("late"))
    assert there.heard == ["done"]


async def test_tests_end_with_the_connection(tmp_path):
    def running():
        return [child for child in psutil.Process().children(recursive=True) if child.pid not in before]

    before = {child.pid for child in psutil.Process().children(recursive=True)}
    async with tools(tmp_path) as (path, _):
        async with client(path, "tests") as socket:
            await socket.send(json.dumps(asked("time.sleep(1000)", tests=1)))
            await asyncio.to_thread(wait_until, lambda: len(running()) > 2, "the child, and that of the test")
        await asyncio.to_thread(wait_until, lambda: not running(), "no process is left")
