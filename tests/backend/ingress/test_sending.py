"""Answers are sent in windows that the client must read in time."""

from __future__ import annotations

import asyncio
import io
import os
from contextlib import suppress
from typing import Any

import pytest

from backend.core.connection_costs import ABORT
from backend.core.tasks import ended as tasks_ended
from backend.ingress import sending
from backend.ingress.sending import (
    WINDOW,
    Answer,
    SlowReaderError,
    cut,
    send_and_close,
    send_answer,
    send_file,
)
from tests.backend.core.test_heads import REQUEST, connected


class Client:
    """A client that reads a number of messages, and then nothing any more."""

    def __init__(self, reads=10_000):
        self.got, self._reads = [], reads

    async def send(self, message):
        if len(self.got) >= self._reads:
            await asyncio.Event().wait()
        self.got.append(message)

    @property
    def bodies(self):
        return [message["body"] for message in self.got if message["type"] == "http.response.body"]


async def read(work):
    return work()


def answer(size, file=None):
    return Answer(200, [], bytes(size), file)


async def test_small_answers_are_one_message_and_large_ones_windows_and_an_end():
    small, large = Client(), Client()
    await send_answer(answer(WINDOW), small.send)
    assert [len(body) for body in small.bodies] == [WINDOW]
    await send_answer(answer(2 * WINDOW + 1), large.send)
    assert [len(body) for body in large.bodies] == [WINDOW, WINDOW, 1, 0]
    assert [message.get("more_body") for message in large.got] == [None, True, True, True, False]


async def test_a_file_is_sent_in_windows_and_closed():
    client, file = Client(), io.BytesIO(bytes(3 * WINDOW))
    await send_file(answer(0, file), file, read, client.send)
    assert sum(map(len, client.bodies)) == 3 * WINDOW
    assert max(map(len, client.bodies)) == WINDOW
    assert file.closed


@pytest.mark.parametrize("reads", [0, 1, 2])
async def test_a_client_that_reads_nothing_more_is_not_waited_for(reads, monkeypatch):
    monkeypatch.setattr(sending, "PATIENCE_S", 0.01)
    file = io.BytesIO(bytes(3 * WINDOW))
    with pytest.raises(SlowReaderError):
        await send_file(answer(0, file), file, read, Client(reads).send)
    assert file.closed
    with pytest.raises(SlowReaderError):
        await send_answer(answer(3 * WINDOW), Client(reads).send)
    receive: Any = asyncio.Event().wait
    with pytest.raises(SlowReaderError):
        await send_and_close(answer(3 * WINDOW), receive, Client(reads).send)


async def test_its_connection_is_ended_with_what_is_unsent():
    ended = []
    with_one: Any = {ABORT: lambda: ended.append(True)}
    without: Any = {}
    await cut(with_one)
    await cut(without)
    assert ended == [True]


@pytest.mark.parametrize("reads", ["nothing", "a byte now and then"])
async def test_a_slow_reader_is_disconnected_and_nothing_stays_in_memory(monkeypatch, reads):
    monkeypatch.setattr(sending, "PATIENCE_S", 0.3)
    ended, size, taken = asyncio.Event(), 64 << 20, []

    async def served(scope, receive, send):
        try:
            await send_answer(answer(size), send)
        except SlowReaderError:
            await cut(scope)
            ended.set()

    async with connected(served) as (reader, writer):
        writer.transport.pause_reading()
        writer.write(REQUEST)

        async def drip():
            while True:
                with suppress(BlockingIOError):
                    taken.append(os.read(writer.get_extra_info("socket").fileno(), 1))
                await asyncio.sleep(0.05)  # the pace is the test: a byte now and then

        dripping = asyncio.create_task(drip()) if reads != "nothing" else None
        await asyncio.wait_for(ended.wait(), 60)
        if dripping is not None:
            await tasks_ended(dripping)
            assert taken
        writer.transport.resume_reading()
        got = 0
        with suppress(ConnectionResetError):
            while part := await reader.read(1 << 20):
                got += len(part)
        assert got < size
