"""The relay between browser and manager, over real sockets."""

from __future__ import annotations

import asyncio
import contextlib
import json
import threading
from typing import Any

import pytest
import uvicorn
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from backend.config.server import _make_server, bind
from backend.core import guard
from backend.core.connection_costs import LARGEST_MESSAGE
from backend.core.websocket import READ_BYTES, PatientSocket
from backend.ingress.sockets import Route, serve
from backend.sessions.consumers import (
    ADDRESS,
    EXECUTOR_FAILED,
    MESSAGES_IN_TURN,
    NO_SUCH_SESSION,
    _browser_to_manager,
    _manager_to_browser,
    may_use,
)
from backend.sessions.consumers import relay as relay_socket
from backend.sessions.lifecycle import writes
from tests.backend.sessions.lifecycle.test_writes import launched

pytestmark = pytest.mark.django_db(transaction=True)
MISSING = "/ws/sessions/00000000-0000-0000-0000-000000000000/control"


async def application(scope, receive, send):
    await serve({ADDRESS: Route(relay_socket, may_use, LARGEST_MESSAGE, as_bytes=True)}, scope, receive, send)


@pytest.fixture
def relay():
    """The sockets behind a real server; its address as a `Host`."""
    listener = bind("127.0.0.1", 0)
    config = uvicorn.Config(application, ws=PatientSocket, lifespan="off", log_config=None)
    server = uvicorn.Server(config)

    async def serve():
        await server.serve(sockets=[listener])
        left = asyncio.all_tasks() - {asyncio.current_task()}
        for task in left:
            task.cancel()
        await asyncio.gather(*left, return_exceptions=True)
        await asyncio.sleep(0)  # sockets to managers that were aborted close in the next round of the loop

    thread = threading.Thread(target=lambda: asyncio.run(serve()))
    thread.start()
    yield f"127.0.0.1:{listener.getsockname()[1]}"
    server.should_exit = True
    thread.join()


@pytest.fixture
def session(api, project, fake_manager):
    """Starts a session on a fake manager of a kind."""

    def start(kind):
        fake_manager(kind)
        return api.post(f"projects/{project['id']}/session")

    yield start
    writes.end_all_sessions()


@contextlib.contextmanager
def opened(host, path, **changes):
    headers = {"Cookie": f"{guard.cookie_name(host)}={guard.keys().cookie_value}"}
    options = {
        "origin": f"http://{host}",
        "additional_headers": headers,
        "proxy": None,
        "compression": None,
        "max_size": None,
    }
    with connect(f"ws://{host}{path}", **options | changes) as socket:
        yield socket


def test_text_and_bytes_go_both_ways_verbatim(relay, session):
    started = session("echo")
    with opened(relay, started["control_url"] + "?client=c1", subprotocols=["bt-studio.v1"]) as socket:
        hello = json.loads(socket.recv())
        assert hello["path"] == "/control?client=c1"
        assert hello["authorization"].startswith("Bearer ")
        assert not hello["user"]  # without accounts nobody has a name
        assert socket.subprotocol == "bt-studio.v1"
        for message in ("", "ä€", "x" * 300_000, "ä€" * 200_000, b"", b"\x00\xff", bytes(3_000_000)):
            socket.send(message)
            assert socket.recv() == message


def test_a_socket_waits_for_a_session_that_starts(relay, session):
    started = session("slow")
    assert started["state"] == "starting"
    with opened(relay, started["stream_url"]) as socket:
        assert json.loads(socket.recv())["path"] == "/stream"


def test_the_managers_close_reaches_the_browser(relay, session):
    with opened(relay, session("echo")["control_url"]) as socket:
        socket.recv()
        socket.send("close")
        with pytest.raises(ConnectionClosed):
            socket.recv()
        assert (socket.close_code, socket.close_reason) == (4321, "as asked")


def test_a_manager_that_dies_is_reported_with_its_reason(relay, session):
    with opened(relay, session("echo")["control_url"]) as socket:
        socket.recv()
        socket.send("die")
        with pytest.raises(ConnectionClosed):
            socket.recv()
        assert socket.close_code == EXECUTOR_FAILED
        assert socket.close_reason


def test_a_session_that_failed_is_reported(relay, session):
    started = session("failing")
    launched(started["id"])
    with opened(relay, started["control_url"]) as socket, pytest.raises(ConnectionClosed):
        socket.recv()
    assert socket.close_code == EXECUTOR_FAILED
    assert "exit status 3" in socket.close_reason


def test_a_session_that_is_not_there_is_reported(relay, db):
    with opened(relay, MISSING) as socket, pytest.raises(ConnectionClosed):
        socket.recv()
    assert socket.close_code == NO_SUCH_SESSION


@pytest.mark.parametrize(
    "attack",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": None},
        {"additional_headers": {}},
        {"additional_headers": {"Cookie": "bt_studio_session=x"}},
        {"additional_headers": {"Authorization": "Bearer wrong"}},
    ],
)
def test_a_foreign_page_opens_no_socket(relay, attack):
    with pytest.raises(InvalidStatus) as caught, opened(relay, MISSING, **attack):
        pass
    assert caught.value.response.status_code == 403


def test_a_rebound_host_opens_no_socket(relay):
    port = relay.rpartition(":")[2]
    cookie = f"{guard.cookie_name(relay)}={guard.keys().cookie_value}"
    rebound = f"evil.example:{port}"
    with (
        pytest.raises(InvalidStatus),
        connect(
            f"ws://{rebound}{MISSING}",
            address=("127.0.0.1", int(port)),
            origin=Origin(f"http://{rebound}"),
            additional_headers={"Cookie": cookie},
            proxy=None,
        ),  # fmt: skip
    ):
        pass


@pytest.mark.parametrize(
    "path", ["/", "/ws/sessions/x/control", "/ws/sessions/../../etc", MISSING + "/x", "/api/v1/me"]
)
def test_other_addresses_have_no_sockets(relay, path):
    with pytest.raises(InvalidStatus), opened(relay, path):
        pass


def test_a_program_may_show_the_token(relay, session):
    headers = {"Authorization": f"Bearer {guard.keys().token}"}
    with opened(relay, session("echo")["control_url"], origin=None, additional_headers=headers) as socket:
        assert json.loads(socket.recv())


def when_it_stops_growing(file, *, limit):
    """Returns the size of the file once it has not changed for a while: all buffers are full then."""
    size = -1
    while (now := file.stat().st_size) != size:
        assert now <= limit, "the relay takes what its browser does not"
        size = now
        threading.Event().wait(0.4)
    return size


def test_a_browser_that_does_not_read_holds_the_manager_up_and_fills_no_queue(
    relay, session, tmp_path, monkeypatch
):
    counter = tmp_path / "sent"
    monkeypatch.setenv("FAKE_MANAGER_COUNTER", str(counter))
    started = session("flood")
    launched(started["id"])
    with opened(relay, started["stream_url"], max_queue=1, close_timeout=0.1) as socket:
        socket.recv()
        stuck = when_it_stops_growing(counter, limit=400)
        for _ in range(stuck + 1):
            socket.recv()
        assert counter.stat().st_size > stuck


async def test_messages_that_are_there_already_leave_other_sockets_their_turn():
    """Neither receiving a message that has arrived nor sending one that fits waits for anything."""
    messages, turns = 1600, 0
    left = messages

    async def receive():
        nonlocal left
        left -= 1
        return {"type": "websocket.receive", "bytes": b"x"} if left else {"type": "websocket.disconnect"}

    async def send(message):
        nonlocal left
        left -= 1
        if not left:
            raise OSError("it has gone")

    class Manager:
        async def send(self, payload, *, text):
            pass

        async def recv(self):
            return "x"

        async def close(self, code):
            pass

    async def count_turns():
        nonlocal turns
        while True:
            turns += 1
            await asyncio.sleep(0)

    manager: Any = Manager()
    for relaying in (
        lambda: _browser_to_manager(receive, manager),
        lambda: _manager_to_browser(manager, send, "user 1"),
    ):
        left, turns = messages, 0
        other = asyncio.create_task(count_turns())
        await relaying()
        other.cancel()
        assert turns >= messages // MESSAGES_IN_TURN - 1


def test_what_a_browser_sends_is_read_little_at_a_time(monkeypatch):
    sizes = []

    class Measured(PatientSocket):
        def data_received(self, data):
            sizes.append(len(data))
            super().data_received(data)

    async def take(scope, receive, send):
        await receive()
        await send({"type": "websocket.accept", "subprotocol": None, "headers": []})
        message = await receive()
        await send({"type": "websocket.send", "text": str(len(message["bytes"])), "bytes": None})

    listener = bind("127.0.0.1", 0)
    server = uvicorn.Server(uvicorn.Config(take, ws=Measured, lifespan="off", log_config=None))
    thread = threading.Thread(target=lambda: asyncio.run(server.serve(sockets=[listener])))
    thread.start()
    with connect(f"ws://127.0.0.1:{listener.getsockname()[1]}", proxy=None, compression=None) as socket:
        socket.send(bytes(1_000_000))
        assert socket.recv(60) == "1000000"
    server.should_exit = True
    thread.join()
    assert max(sizes) <= READ_BYTES
    assert _make_server(lambda: None, 1).config.ws is PatientSocket
