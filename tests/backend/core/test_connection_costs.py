"""Connections of an owner over their share are read later; their unfinished messages are limited in size."""

from __future__ import annotations

import asyncio
import contextlib
import struct

import pytest
import uvicorn

from backend.core import connection_costs, websocket
from backend.core.connection_costs import LEAST_OF_OWNER, ConnectionCosts, known
from backend.core.heads import PatientProtocol
from backend.core.processes.budgets import BURST_S, LONGEST_REST_S, SHARE, Budgets
from backend.core.processes.memory import MESSAGE_MIB
from backend.core.readers import SMALL, Readers, readers
from backend.core.websocket import MOST_BYTES, PatientSocket
from tests.hostile.wire import frame

REQUEST = b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"
HANDSHAKE = (
    b"GET /%d HTTP/1.1\r\nHost: x\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)


SLOW = 90


@pytest.fixture
def passing_on():
    return asyncio.Event()


class Clock:
    now_s = 100.0

    def __call__(self):
        return self.now_s


class Settings:
    is_team, proxy_hops = True, 0


@pytest.fixture
def budgets(monkeypatch):
    made = Budgets(clock=Clock())
    monkeypatch.setattr(connection_costs, "budgets", made)
    monkeypatch.setattr(connection_costs, "environment", lambda: Settings)
    monkeypatch.setattr(Settings, "proxy_hops", 0)
    made.spend("somebody else", 0.001)
    return made


@contextlib.asynccontextmanager
async def listening(passing_on=None):
    """A server that answers requests, and accepts messages of any size from sockets; the path is the owner.

    Messages of slow owners are passed on when `passing_on` is set.
    """

    async def application(scope, receive, send):
        if scope["type"] == "websocket":
            known(scope, scope["path"])
            await receive()
            await send({"type": "websocket.accept", MOST_BYTES: 1 << 20})
            while (await receive())["type"] == "websocket.receive":
                if passing_on is not None and scope["path"].startswith("/9"):
                    await passing_on.wait()
            return
        await receive()
        await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"2")]})
        await send({"type": "http.response.body", "body": b"ok"})

    config = uvicorn.Config(
        application, http=PatientProtocol, ws=PatientSocket, lifespan="off", log_config=None
    )
    config.load()
    server = uvicorn.Server(config)
    made = await asyncio.get_running_loop().create_server(
        lambda: PatientProtocol(config=config, server_state=server.server_state, app_state={}), "127.0.0.1"
    )
    writers = []

    async def connect():
        reader, writer = await asyncio.open_connection(*made.sockets[0].getsockname())
        writers.append(writer)
        return reader, writer

    async with made:
        yield connect
        for writer in writers:
            writer.transport.abort()
            with contextlib.suppress(OSError):
                await writer.wait_closed()
        async with asyncio.timeout(60):
            while server.server_state.connections or server.server_state.tasks:  # noqa: ASYNC110 - uvicorn's
                await asyncio.sleep(0)


async def answered(reader):
    async with asyncio.timeout(60):
        return (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 200")


async def test_a_connection_of_an_address_over_its_share_is_read_after_its_rest(budgets):
    loop = asyncio.get_running_loop()
    async with listening() as connect:
        reader, writer = await connect()
        writer.write(REQUEST)
        assert await answered(reader)
        budgets.spend("address 127.0.0.1", BURST_S + 0.3 * SHARE)
        began_s = loop.time()
        reader, writer = await connect()
        writer.write(REQUEST)
        assert await answered(reader)
        assert loop.time() - began_s >= 0.29


async def test_a_proxy_s_connections_are_read_no_matter_who_used_them(budgets, monkeypatch):
    monkeypatch.setattr(Settings, "proxy_hops", 1)
    budgets.spend("address 127.0.0.1", 100.0)
    assert ConnectionCosts("127.0.0.1").rest_s() == 0.0


def test_a_connection_is_booked_for_its_owner_once_known(budgets):
    costs = ConnectionCosts("127.0.0.1")
    known({connection_costs.COSTS: costs}, "user 7")
    budgets.spend("user 7", 100.0)
    assert costs.rest_s() == pytest.approx(LONGEST_REST_S)
    assert ConnectionCosts("127.0.0.1").rest_s() == 0.0


async def open_socket(connect, owner):
    reader, writer = await connect()
    writer.write(HANDSHAKE % owner)
    async with asyncio.timeout(60):
        assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 101")
    return reader, writer


async def ended(reader, code=1009):
    """Waits for the end of the connection.

    Data that the client still sends may overtake the close frame, which is then lost.
    """
    with contextlib.suppress(ConnectionResetError):
        async with asyncio.timeout(60):
            said = await reader.read()
            assert said == b"" or struct.unpack("!xxH", said[:4]) == (code,)


@pytest.mark.usefixtures("budgets")
async def test_unfinished_messages_of_one_owner_are_bounded_together(monkeypatch):
    them = Readers(None, 200_000)
    monkeypatch.setattr(connection_costs, "messages", lambda: them)
    monkeypatch.setattr(connection_costs, "LEAST_OF_OWNER", 0)
    part = frame(bytes(60_000), opcode=2, is_last=False)
    async with listening() as connect:
        other, _ = await open_socket(connect, 2)
        first, writing = await open_socket(connect, 1)
        writing.write(part)
        second, more = await open_socket(connect, 1)
        more.write(part)
        done, _ = await asyncio.wait(
            [asyncio.ensure_future(ended(reader)) for reader in (first, second)],
            return_when=asyncio.FIRST_COMPLETED,
        )
        assert [task.result() for task in done] == [None]
        assert not other.at_eof()
        _, again = await open_socket(connect, 2)
        again.write(part)
        await again.drain()


@pytest.mark.usefixtures("budgets")
async def test_messages_that_are_passed_on_count_no_longer(monkeypatch):
    them = Readers(None, 200_000)
    monkeypatch.setattr(connection_costs, "messages", lambda: them)
    monkeypatch.setattr(connection_costs, "LEAST_OF_OWNER", 100_000)
    async with listening() as connect:
        reader, writer = await open_socket(connect, 1)
        for _ in range(5):
            writer.write(frame(bytes(60_000), opcode=2))
            await writer.drain()
        writer.write(frame(b"", opcode=9))
        async with asyncio.timeout(60):
            assert (await reader.readexactly(1))[0] & 15 == 10  # a pong: the socket lives
        await until(lambda: them.total == 0)  # of the ping, too


@pytest.mark.usefixtures("budgets")
@pytest.mark.parametrize("is_whole", [True, False])
async def test_messages_of_all_owners_are_bounded_together_until_they_are_passed_on(
    monkeypatch, passing_on, is_whole
):
    """A whole message is in memory, too, while the application waits for whom it is sent to."""
    them, answers = Readers(None, 4 * SMALL), readers().total
    monkeypatch.setattr(connection_costs, "messages", lambda: them)
    large = frame(bytes(3 * SMALL), opcode=2, is_last=is_whole)
    async with listening(passing_on) as connect:
        first, writer = await open_socket(connect, SLOW)
        writer.write(large)
        await until(lambda: them.total >= 3 * SMALL)
        assert readers().total == answers  # messages refuse no answers
        second, more = await open_socket(connect, SLOW + 1)
        more.write(frame(bytes(100), opcode=2))  # small ones pass whatever others hold
        await until(lambda: them.total >= 3 * SMALL + 100)
        more.write(large)
        await ended(second)
        assert not first.at_eof()
        await until(lambda: them.total < 4 * SMALL)
        writer.write(frame(b"", opcode=9))
        passing_on.set()
        if is_whole:
            await until(lambda: them.total < SMALL)
    assert them.total == 0


def test_a_large_message_passes_while_others_hold_little():
    them = Readers(None, 2 * SMALL)
    assert them.of("olga").grow(100, SMALL)
    large = them.of("otto")
    assert large.grow(3 * SMALL, 4 * SMALL)
    assert not large.grow(2 * SMALL, 4 * SMALL)
    assert not them.of("eve").grow(SMALL + 1, 4 * SMALL)


@pytest.mark.parametrize(("most", "of_owner"), [(512 << 20, 256 << 20), (36 << 20, LEAST_OF_OWNER)])
@pytest.mark.usefixtures("budgets")
def test_an_owner_may_hold_half_of_all_and_never_less_than_the_largest_message(monkeypatch, most, of_owner):
    assert LEAST_OF_OWNER == MESSAGE_MIB << 20
    them = Readers(None, most)
    monkeypatch.setattr(connection_costs, "messages", lambda: them)
    costs = ConnectionCosts("127.0.0.1")
    assert costs.hold(of_owner)
    assert not costs.hold(1)


@pytest.mark.usefixtures("budgets")
async def test_a_message_that_comes_to_no_end_is_given_up(monkeypatch):
    monkeypatch.setattr(websocket, "PATIENCE_S", 0.05)
    them = Readers(None, 4 * SMALL)
    monkeypatch.setattr(connection_costs, "messages", lambda: them)
    async with listening() as connect:
        quiet, _ = await open_socket(connect, 2)
        reader, writer = await open_socket(connect, 1)
        writer.write(frame(bytes(1000), opcode=2, is_last=False))
        await ended(reader, 1008)
        assert not quiet.at_eof()


@pytest.mark.usefixtures("budgets")
async def test_a_message_that_the_server_does_not_read_is_not_too_slow(monkeypatch, passing_on):
    monkeypatch.setattr(websocket, "PATIENCE_S", 0.01)
    monkeypatch.setattr(websocket, "SLOWEST", 1)
    them = Readers(None, 4 * SMALL)
    monkeypatch.setattr(connection_costs, "messages", lambda: them)
    loop = asyncio.get_running_loop()
    async with listening(passing_on) as connect:
        reader, writer = await open_socket(connect, SLOW)
        whole = frame(bytes(100), opcode=2)
        # The first is being passed on, the second waits, so that the rest of the third is not read.
        writer.write(whole + whole + whole[:50])
        await until(lambda: them.total >= 200)
        began_s = loop.time()
        await until(lambda: loop.time() - began_s > 20 * websocket.PATIENCE_S)
        assert not reader.at_eof()
        passing_on.set()
        writer.write(whole[50:] + frame(b"", opcode=9))
        async with asyncio.timeout(60):
            assert (await reader.readexactly(1))[0] & 15 == 10


async def until(true):
    async with asyncio.timeout(60):
        while not true():  # noqa: ASYNC110 - a count gives no event
            await asyncio.sleep(0)
