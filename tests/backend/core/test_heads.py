"""The time and the bytes that a connection may cost before its request is known."""

from __future__ import annotations

import asyncio
import contextlib
import json

import uvicorn

from backend.core import heads
from backend.core.heads import PatientProtocol


async def application(scope, receive, send):
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]})
    await send({"type": "http.response.body", "body": b"ok"})


@contextlib.asynccontextmanager
async def connected(served=application):
    """A connection to a server that uses our protocol."""
    config = uvicorn.Config(served, http=PatientProtocol, lifespan="off", log_config=None)
    config.load()
    server = uvicorn.Server(config)
    loop = asyncio.get_running_loop()
    listening = await loop.create_server(
        lambda: PatientProtocol(config=config, server_state=server.server_state, app_state={}), "127.0.0.1"
    )
    async with listening:
        reader, writer = await asyncio.open_connection(*listening.sockets[0].getsockname())
        yield reader, writer
        writer.close()


REQUEST = b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"


async def answered(reader):
    head = await reader.readuntil(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 200")
    await reader.readexactly(2)


async def whole(reader):
    """Returns the bytes that arrive until the other side closes."""
    return await asyncio.wait_for(reader.read(), 60)


async def test_a_head_that_does_not_end_is_given_up_with_an_answer(monkeypatch):
    monkeypatch.setattr(heads, "HEAD_S", 0.3)
    async with connected() as (reader, writer):
        writer.write(b"GET / HTTP/1.1\r\nHost: x\r\n")
        head, _, body = (await whole(reader)).partition(b"\r\n\r\n")
        assert head.startswith(b"HTTP/1.1 408")
        assert json.loads(body)["code"] == "request_too_slow"


async def test_bytes_now_and_then_do_not_make_it_wait_longer(monkeypatch):
    monkeypatch.setattr(heads, "HEAD_S", 0.5)
    async with connected() as (reader, writer):

        async def drip():
            for piece in [b"GET / HTTP/1.1\r\n", *[b"X: 1\r\n"] * 500]:
                writer.write(piece)
                await asyncio.sleep(0.1)  # the pace is the test: a byte now and then

        dripping = asyncio.create_task(drip())
        assert b" 408 " in (await whole(reader)).partition(b"\r\n")[0]
        assert not dripping.done()
        dripping.cancel()


async def test_a_connection_that_says_nothing_is_closed(monkeypatch):
    monkeypatch.setattr(heads, "HEAD_S", 0.3)
    async with connected() as (reader, _):
        assert await whole(reader) == b""


async def test_the_next_request_has_its_own_time_and_empty_lines_are_none(monkeypatch):
    monkeypatch.setattr(heads, "HEAD_S", 0.5)
    async with connected() as (reader, writer):
        for _ in range(3):
            writer.write(REQUEST)
            await answered(reader)
            await asyncio.sleep(0.3)  # the time is the test: three of these are longer than HEAD_S
        writer.write(REQUEST[:-2])
        await asyncio.sleep(0.1)  # the time is the test: the head arrives in two pieces
        writer.write(b"\r\n")
        await answered(reader)
        writer.write(b"\r\n")  # this ends the wait for the next request, but does not begin one
        assert await whole(reader) == b""


async def test_a_long_body_is_no_head(monkeypatch):
    monkeypatch.setattr(heads, "HEAD_S", 0.3)
    async with connected() as (reader, writer):
        writer.write(b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 200000\r\n\r\n")
        for _ in range(4):
            writer.write(b"x" * 50_000)
            await asyncio.sleep(0.2)  # the time is the test: the body takes longer than HEAD_S
        await answered(reader)


async def test_a_head_without_end_is_refused():
    async with connected() as (reader, writer):
        writer.write(b"GET / HTTP/1.1\r\n" + b"X-A: " + b"a" * 70_000)
        head, _, body = (await whole(reader)).partition(b"\r\n\r\n")
        assert head.startswith(b"HTTP/1.1 431")
        assert json.loads(body)["code"] == "head_too_large"
