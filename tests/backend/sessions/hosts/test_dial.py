"""A manager behind a relay is reached as one on this machine: by asyncio, by threads and as HTTP."""

from __future__ import annotations

import asyncio
import http.client
from contextlib import closing
from uuid import uuid4

import pytest
from websockets.asyncio.server import unix_serve
from websockets.exceptions import InvalidHandshake, WebSocketException

from backend.sessions.hosts.authority import renew_web_bundle
from backend.sessions.hosts.dial import NotReachedError, dial, web_bundle
from backend.sessions.hosts.names import HostAddress
from backend.sessions.manager.address import http_connection, open_socket, open_sync_socket
from backend.sessions.relay.hello import KEEPER, socket_of

SESSION = str(uuid4())


@pytest.fixture
def reached(relay, settings_of):
    """A relay that knows this web server."""
    settings_of(data_dir=relay.folder)
    web_bundle.cache_clear()
    renew_web_bundle(relay.authority)
    relay.authority.rename(relay.folder / "hosts")
    relay.start()
    yield relay
    web_bundle.cache_clear()


async def test_a_manager_behind_a_relay_is_reached_in_all_ways(reached):
    async def serve(socket):
        await socket.send(socket.request.path)
        await socket.send(await socket.recv())

    def answer(connection, request):
        return connection.respond(200, "well") if request.path == "/health" else None

    path = reached.sockets / socket_of(SESSION)
    path.parent.mkdir()
    address = f"tls://127.0.0.1:{reached.port}/{SESSION}"

    def from_a_thread():
        with open_sync_socket(address, "stream", open_timeout=60) as socket:
            heard = socket.recv()
            assert socket.socket.gettimeout() is None
            socket.send(b"x" * 500_000)
            assert socket.recv() == b"x" * 500_000
        connection = http_connection(address, 60)
        connection.request("GET", "/health")
        with connection.getresponse() as response:
            told = response.status, response.read()
        connection.close()
        return heard, *told

    async with unix_serve(serve, str(path), process_request=answer):
        async with open_socket(address, "control?a=1", open_timeout=60) as socket:
            assert await socket.recv() == "/control?a=1"
            await socket.send("y" * 500_000)
            assert await socket.recv() == "y" * 500_000
        assert await asyncio.to_thread(from_a_thread) == ("/stream", 200, b"well")


async def test_a_session_that_a_host_does_not_have_is_not_reached(reached):
    address = f"tls://127.0.0.1:{reached.port}/{SESSION}"
    with pytest.raises((OSError, InvalidHandshake)):
        async with open_socket(address, "control"):
            pass
    with pytest.raises((OSError, WebSocketException)):
        await asyncio.to_thread(open_sync_socket, address, "control")
    connection = http_connection(address, 60)
    with closing(connection), pytest.raises((OSError, http.client.HTTPException)):
        await asyncio.to_thread(ask_for_health, connection)


def ask_for_health(connection):
    connection.request("GET", "/health")
    connection.getresponse()


def test_a_host_without_a_relay_or_with_another_name_is_not_reached(reached):
    with pytest.raises(NotReachedError, match="certificate"):
        dial(HostAddress("localhost", reached.port), KEEPER, 60)
    reached.process.terminate()
    reached.process.wait(60)
    with pytest.raises(NotReachedError, match=r"127\.0\.0\.1"):
        dial(HostAddress("127.0.0.1", reached.port), KEEPER, 60)


def test_a_server_without_a_certificate_says_what_to_do(reached):
    (reached.folder / "hosts" / "web.pem").unlink()
    web_bundle.cache_clear()
    with pytest.raises(NotReachedError, match="bt-studio hosts certificate"):
        dial(HostAddress("127.0.0.1", reached.port), KEEPER, 60)
