"""The RAM dialect as raw frames, with fake children."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import random
import sys
from typing import Any

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from executor import messages
from executor.manager.admission import is_loopback
from executor.manager.manager import Manager, ManagerSettings
from executor.ram.monitor import update_text
from executor.ram.server import REFUSED
from tests.budget import count
from tests.executor.manager.test_server import empty_zip, manager

CODE = f"data:application/zip;base64,{empty_zip()}"


class Raw:
    """A client of the dialect, frame by frame."""

    def __init__(self, socket):
        self.socket = socket
        self.count = 0
        self.seen = []

    async def ask(self, command, data=None):
        """Sends a command; returns the messages up to its answer, shortened."""
        self.count += 1
        await self.socket.send(json.dumps({"id": f"r{self.count}", "command": command, "data": data}))
        came: list[Any] = []
        while not came or came[-1][0] not in {"ack", "error"}:
            message = json.loads(await asyncio.wait_for(self.socket.recv(), 60))
            data = message["data"]
            short = {"state-changed": "state", "error": "message"}.get(message["command"])
            if message["command"] != "update":
                came.append((message["command"], data[short] if short else None))
            self.seen.append(message)
        assert self.seen[-1]["id"] == f"r{self.count}"
        return came


@contextlib.asynccontextmanager
async def ram(**more):
    async with (
        manager(is_ram=True, grace_s=0, **more) as it,
        connect(f"ws://127.0.0.1:{it.port}", proxy=None) as socket,
    ):
        yield it, Raw(socket)


def changed(state):
    return [("state-changed", state), ("ack", None)]


async def test_a_session_of_2024_has_its_names_and_its_order_of_messages():
    async with ram() as (_, raw):
        assert await raw.ask("connect") == [("introspection", None), *changed("connected")]
        old = {"name": "follow_person_ros2", "launch_file_path": "/opt/f.launch.py", "world": "gazebo"}
        assert await raw.ask("launch_world", old) == changed("world_ready")
        assert await raw.ask("prepare_visualization", "gazebo_rae") == changed("visualization_ready")
        run = await raw.ask("run_application", {"type": "bt-studio", "code": CODE})
        assert run == changed("application_running")
        assert await raw.ask("pause") == changed("paused")
        assert await raw.ask("terminate_application") == changed("visualization_ready")
        assert await raw.ask("terminate_visualization") == changed("world_ready")
        assert await raw.ask("terminate_universe") == changed("connected")
        assert await raw.ask("disconnect") == changed("idle")


@pytest.mark.parametrize(
    ("command", "data", "text"),
    [
        ("pause", None, '"Can\'t trigger event pause from state idle!"'),
        ("terminate_tools", None, '"Can\'t trigger event terminate_tools from state idle!"'),
        ("to_application_running", None, "Do not know event named 'to_application_running'."),
        ("launch_universe", {"universe": "empty"}, "Do not know event named 'launch_universe'."),
        ("reset", None, "Do not know event named 'reset'."),
        ("run_application", {"code": "eA=="}, "the code is not a data URL"),
        ("run_application", {}, "User code not found"),
        ("launch_world", {"name": "Mars"}, "the world 'Mars' is not known here; there are"),
        ("launch_world", [], "launch_world needs an object"),
        ("prepare_visualization", {"x": 1}, "there is no visualization"),
        ("prepare_tools", {"tools": 5}, "prepare_tools needs a list"),
        ("code_format", {"code": "x"}, "code_format is not offered here"),
    ],
)
async def test_what_is_wrong_has_the_text_of_the_dialect_and_the_socket_stays(command, data, text):
    async with ram() as (_, raw):
        [(kind, message)] = await raw.ask(command, data)
        assert (kind, message.startswith(text)) == ("error", True)
        for frame in ("no json", "[]", '{"command": "connect"}', b"\x00", "[" * 50_000):
            await raw.socket.send(frame)
            assert json.loads(await raw.socket.recv())["command"] == "error"
        await raw.socket.send('{"id": "g", "command": "gui", "data": 1}')
        assert (await raw.ask("connect"))[-1] == ("ack", None)


async def test_a_second_client_learns_why_it_is_refused_and_a_later_one_gets_a_new_session():
    async with ram() as (it, raw):
        await raw.ask("connect")
        await raw.ask("launch_world", {"name": "empty"})
        async with connect(f"ws://127.0.0.1:{it.port}", proxy=None) as second:
            with pytest.raises(ConnectionClosed):
                await second.recv()
            assert (second.close_code, "another client" in second.close_reason) == (REFUSED, True)
        await raw.socket.close()
        async with connect(f"ws://127.0.0.1:{it.port}", proxy=None) as socket:
            assert await Raw(socket).ask("connect") == [("introspection", None), *changed("connected")]


@pytest.mark.parametrize(
    ("origin", "is_welcome"),
    [
        ("http://localhost:7164", True),
        ("http://127.0.0.1:3000", True),
        ("https://studio.example", True),
        ("https://evil.example", False),
        ("http://localhost.evil.example", False),
        ("null", False),
    ],
)
async def test_only_pages_of_this_machine_or_of_the_list_may_drive(origin, is_welcome):
    async with manager(is_ram=True, origins=("https://studio.example",)) as it:
        url = f"ws://127.0.0.1:{it.port}"
        if is_welcome:
            async with connect(url, proxy=None, origin=origin):
                return
        with pytest.raises(InvalidStatus) as caught:
            await connect(url, proxy=None, origin=origin)
        assert caught.value.response.status_code == 403


async def test_a_page_whose_name_was_made_to_point_here_is_refused():
    async with manager(is_ram=True) as it:
        reader, writer = await asyncio.open_connection("127.0.0.1", it.port)
        handshake = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        key = "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
        writer.write(f"GET / HTTP/1.1\r\nHost: evil.example:{it.port}\r\n{handshake}{key}\r\n".encode())
        assert (await reader.readline()).split()[1] == b"421"
        writer.close()


async def test_it_listens_on_loopback_alone():
    assert all(is_loopback(host) for host in ("127.0.0.1", "::1", "localhost"))
    assert not any(is_loopback(host) for host in ("0.0.0.0", "10.0.0.1", "example.org"))  # noqa: S104
    it = Manager(ManagerSettings(host="0.0.0.0", port=0, programs={}, is_ram=True))  # noqa: S104
    with pytest.raises(OSError, match="loopback"):
        await it.start()
    await it.close()


async def test_the_death_of_an_application_is_reported_with_its_state():
    async with ram(application="dies_when_started") as (_, raw):
        await raw.ask("connect")
        await raw.ask("launch_world", {"name": "maze", "scene": {"name": "x", "type": None}})
        await raw.ask("prepare_tools", {"tools": ["state_monitor"], "config": {}})
        [(kind, text)] = await raw.ask("run_application", {"entrypoint": "x", "linter": [], "code": CODE})
        assert (kind, "exit code 4" in text) == ("error", True)


def test_the_monitor_nests_nodes_by_name():
    from executor.session.mirror import Mirror

    mirror = Mirror()
    nodes = [(1, 0, "root"), (2, 1, "a"), (3, 1, "a"), (4, 2, "")]
    mirror.apply(
        messages.Tree([messages.TreeNode(u, p, "Sequence", "control", n, n, "", "") for u, p, n in nodes])
    )
    mirror.apply(messages.Tick(1, [(1, "RUNNING"), (2, "SUCCESS"), (3, "SKIPPED")], [], 0.1))
    mirror.apply(messages.Blackboard([messages.BlackboardEntry("", "speed", "float", 0.3)]))
    assert json.loads(update_text(mirror)) == {
        "tree": {
            "root": {
                "state": "RUNNING",
                "a": {"state": "SUCCESS", "Sequence": {"state": "INVALID"}},
                "a_2": {"state": "INVALID"},
            }
        },
        "blackboard": {"speed": "0.3"},
    }


async def test_random_frames_are_all_answered_and_the_client_is_served_still():
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    chance = random.Random(seed)  # noqa: S311
    names = [
        "connect",
        "launch_world",
        "prepare_tools",
        "run_application",
        "pause",
        "terminate_world",
        "x",
        "",
    ]
    values = [None, 1, "x", [], {}, {"name": "empty"}, {"tools": []}, {"code": CODE}, {"scene": {"zip": 1}}]
    async with ram() as (_, raw):
        for n in range(count("manager_fuzz_frames") // 10):
            text = json.dumps({"id": f"f{n}", "command": chance.choice(names), "data": chance.choice(values)})
            if chance.random() < 0.2:
                cut = chance.randrange(len(text))
                text = text[:cut] + chance.choice(["", "\x00", "}", '"']) + text[cut + 1 :]
            await raw.socket.send(text)
            command = ""
            while command not in {"ack", "error"}:
                command = json.loads(await asyncio.wait_for(raw.socket.recv(), 60))["command"]
        assert (await raw.ask("disconnect"))[-1] == ("ack", None)
