"""Limits of a socket that sends nothing, or nothing yet: the test sends raw frames to the real server."""

from __future__ import annotations

import asyncio
import struct
from contextlib import asynccontextmanager

import pytest
import requests

from backend.core.websocket import IDLE_FRAMES, SMALL_BYTES
from tests.backend.serving import serving
from tests.hostile.wire import Site, frame, websocket

PING, PONG, TEXT, MORE = 9, 10, 1, 0


@pytest.fixture(scope="module")
def notices(tmp_path_factory):
    """The address of a project's notices, the headers that open it, and the server."""
    with serving(tmp_path_factory.mktemp("served")) as served:
        made = requests.post(
            f"{served.base}/api/v1/projects", json={"name": "P"}, headers=served.headers, timeout=60
        )
        site = Site("127.0.0.1", served.port, served.base, "", "", "", "")
        yield site, f"/ws/projects/{made.json()['id']}/notices", served.headers


@asynccontextmanager
async def opened(notices):
    site, path, headers = notices
    async with websocket(site, path, **headers) as (status, (reader, writer)):
        assert status == "101"
        assert (await read(reader))[0] == TEXT  # the newest revision
        yield reader, writer


async def read(reader):
    """Returns the kind and the content of the server's next frame."""
    async with asyncio.timeout(60):
        first, length = await reader.readexactly(2)
        if length == 126:
            length = struct.unpack("!H", await reader.readexactly(2))[0]
        return first & 15, await reader.readexactly(length)


async def close_code(reader):
    while (found := await read(reader))[0] != 8:
        pass
    return struct.unpack("!H", found[1][:2])[0]


async def test_a_few_pings_are_answered(notices):
    async with opened(notices) as (reader, writer):
        writer.write(frame(b"here", opcode=PING))
        assert await read(reader) == (PONG, b"here")


@pytest.mark.parametrize(
    "idle", [frame(b"x", opcode=PING), frame(b"x", opcode=PONG), frame(b"", opcode=MORE, is_last=False)]
)
async def test_frames_that_say_nothing_end_the_socket(notices, idle):
    async with opened(notices) as (reader, writer):
        begun = frame(b"", is_last=False) if idle[0] & 15 == MORE else b""
        writer.write(begun + idle * (IDLE_FRAMES + 5))  # as much as is read in one step
        assert await close_code(reader) == 1008


async def test_who_has_nothing_to_say_says_little_and_once(notices):
    async with opened(notices) as (reader, writer):
        writer.write(frame(b"", says=SMALL_BYTES + 1))
        assert await close_code(reader) == 1009
    async with opened(notices) as (reader, writer):
        writer.write(frame(b"hello"))
        assert await close_code(reader) == 1008


async def test_a_stranger_is_refused_before_anything_is_read(notices):
    site, path, _ = notices
    async with websocket(site, path) as (status, _):
        assert status == "403"
