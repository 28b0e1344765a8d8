"""The sockets of a session with fake children."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import io
import json
import math
import os
import random
import sys
import urllib.error
import urllib.request
import zipfile
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import InvalidStatus

from executor.manager.allowance import Allowance
from executor.manager.manager import Manager, ManagerSettings
from executor.messages import COMMANDS
from executor.stream.outbox import ControlOutbox, StreamOutbox
from executor.supervision.processes import Program
from tests.budget import count
from tests.executor.session_client import TOKEN, SessionClient

ROOT = Path(__file__).parents[3]
FAKE = str(ROOT / "tests" / "fakes" / "child.py")


def empty_zip():
    packed = io.BytesIO()
    zipfile.ZipFile(packed, "w").close()
    return base64.b64encode(packed.getvalue()).decode()


RUN = {"universe": {"universe": "x"}, "application": {"app_zip_base64": empty_zip()}}


@contextlib.asynccontextmanager
async def manager(world="good", application="good", **settings):
    environment = {"PYTHONPATH": str(ROOT)}
    programs: Any = {
        "world": Program((sys.executable, FAKE, world), environment),
        "application": Program((sys.executable, FAKE, application), environment),
    }
    it = Manager(ManagerSettings(port=0, token=TOKEN, domain_id=41, programs=programs, **settings))
    try:
        it.port = await it.start()  # type: ignore[attr-defined]
        yield it
    finally:
        await it.close()


@contextlib.asynccontextmanager
async def session(**more):
    async with manager(**more) as it:
        client = await SessionClient(it.port).open()
        yield client
        await client.close()


async def test_a_whole_session_with_obedient_children():
    async with session() as client:
        assert await client.ask("subscribe", {"stream": "poses"}) == "ack"
        assert await client.ask("run", RUN) == "ack"
        for command, state in [
            ("pause", "paused"),
            ("step", "paused"),
            ("resume", "application_running"),
            ("terminate_application", "visualization_ready"),
            ("terminate_visualization", "universe_ready"),
            ("terminate_universe", "connected"),
            ("disconnect", "idle"),
        ]:
            assert await client.ask(command) == "ack"
            assert client.state == state
        numbers = [e["seq"] for e in client.events]
        assert numbers == sorted(numbers)


@pytest.mark.parametrize("habit", ["dies_at_start", "dies_when_started", "talks_rubbish", "closes_pipe"])
@pytest.mark.parametrize("kind", ["world", "application"])
async def test_bad_children_are_reported_and_the_session_stays(kind, habit):
    async with session(**{kind: habit}) as client:
        reply = await client.ask("run", RUN)
        assert reply["code"] == "process_died"
        assert client.state == ("connected" if kind == "world" else "visualization_ready")
        assert (await client.ask("run", RUN))["code"] == "process_died"
        assert await client.ask("disconnect") == "ack"


async def test_cancel_works_while_a_world_is_never_ready():
    async with session(world="never_ready") as client:
        run = await client.send("run", RUN)
        await client.event("state-changed")
        assert await client.ask("cancel") == "ack"
        reply = await client.until(lambda: next((e for e in client.events if e["id"] == run), None))
        assert reply["data"]["code"] == "cancelled"


@pytest.mark.parametrize(
    ("frame", "code"),
    [
        ("no json", "bad_frame"),
        (b"\x00binary", "bad_frame"),
        ("[]", "bad_frame"),
        ('{"id": 1, "command": "connect"}', "bad_frame"),
        ('{"id": "a", "command": "to_idle"}', "unknown_command"),
        ('{"id": "a", "command": "set_speed", "data": {"speed": 99}}', "bad_data"),
        ('{"id": "a", "command": "set_speed", "data": {"speed": NaN}}', "bad_frame"),
        ('{"id": "a", "command": "set_speed", "data": {}}', "bad_data"),
        ('{"id": "a", "command": "pause"}', "wrong_state"),
        ("[" * 100_000, "bad_frame"),
    ],
)
async def test_a_bad_frame_gets_an_error_and_the_socket_stays(frame, code):
    async with session() as client:
        await client.control.send(frame)
        assert (await client.event("error"))["data"]["code"] == code
        assert await client.ask("connect") == "ack"


def answered(client):
    """Counts new replies and drops them: a long test must not count them repeatedly."""
    replies = sum(event["command"] in {"ack", "error"} for event in client.events)
    client.events.clear()
    client.replies = getattr(client, "replies", 0) + replies
    return client.replies


async def test_random_frames_are_all_answered(monkeypatch):
    monkeypatch.setattr("executor.manager.server.Allowance", lambda now_s: Allowance(now_s, burst=math.inf))
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    chance = random.Random(seed)  # noqa: S311
    frames = count("manager_fuzz_frames")
    values = [None, 1, -1.5, 1e308, "x", "é" * 50, [], {}, [[1]], {"stream": "poses"}, {"speed": 1}, True]
    names = [*COMMANDS, "", "x"]
    async with session() as client:
        for n in range(frames):
            if n % 500 == 0:
                await client.until(lambda n=n: answered(client) >= n, 100)
            message = {"id": f"f{n}", "command": chance.choice(names), "data": chance.choice(values)}
            text = json.dumps(message)
            if chance.random() < 0.2:
                cut = chance.randrange(len(text))
                text = text[:cut] + chance.choice(["", "\x00", "}", '"']) + text[cut + 1 :]
            await client.control.send(text)
        await client.until(lambda: answered(client) >= frames, 100)
        assert await client.ask("disconnect") == "ack"


@pytest.mark.parametrize("header", [None, "Bearer wrong", TOKEN])
async def test_without_the_token_access_is_refused(header):
    async with manager() as it:
        client = SessionClient(it.port)
        client.headers = {"Authorization": header} if header else {}
        with pytest.raises(InvalidStatus) as caught:
            await client.open()
        assert caught.value.response.status_code == 401


async def test_health_is_answered_without_a_token_and_other_paths_do_not_exist():
    async with manager() as it:

        def get(path, token=""):
            request = urllib.request.Request(f"http://127.0.0.1:{it.port}{path}")
            request.add_header("Authorization", f"Bearer {token}")
            try:
                with urllib.request.urlopen(request) as reply:  # noqa: S310
                    return reply.status, reply.read()
            except urllib.error.HTTPError as error:
                with error:
                    return error.code, b""

        status, body = await asyncio.to_thread(get, "/health")
        assert status == 200
        assert json.loads(body)["state"] == "idle"
        assert (await asyncio.to_thread(get, "/elsewhere", TOKEN))[0] == 404


async def test_metrics_have_the_text_format():
    async with session() as client:
        await client.ask("run", RUN)
        await client.ask("subscribe", {"stream": "poses"})
        await client.control.send("no json")
        await client.event("error")

        def get():
            request = urllib.request.Request(f"http://127.0.0.1:{client.port}/metrics")
            request.add_header("Authorization", f"Bearer {TOKEN}")
            with urllib.request.urlopen(request) as reply:  # noqa: S310
                return reply.headers["Content-Type"], reply.read().decode()

        kind, text = await asyncio.to_thread(get)
        assert kind.startswith("text/plain; version=0.0.4")
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        values = {name: float(value) for name, value in (line.rsplit(" ", 1) for line in lines)}
        assert values['bt_studio_session_state{state="application_running"}'] == 1
        assert values['bt_studio_session_state{state="idle"}'] == 0
        assert (values["bt_studio_clients"], values["bt_studio_streams"]) == (1, 1)
        assert (values["bt_studio_commands_total"], values["bt_studio_commands_refused_total"]) == (3, 1)
        assert values["bt_studio_memory_bytes"] > 1e6
        assert len(values) == len(lines)


async def test_a_stream_needs_a_control_socket():
    async with manager() as it:
        client = SessionClient(it.port)
        stream = await client._connect("/stream?client=nobody")
        await stream.wait_closed()
        assert stream.close_code == 4404


async def test_a_viewer_sees_all_and_drives_nothing():
    async with manager() as it:
        driver = await SessionClient(it.port).open()
        await driver.ask("run", RUN)
        viewer = await SessionClient(it.port).open()
        assert viewer.named("introspection")[0]["role"] == "viewer"
        assert viewer.named("snapshot")[0]["state"] == "application_running"
        assert (await viewer.ask("pause"))["code"] == "not_driver"
        await driver.ask("pause")
        await viewer.event("state-changed", lambda d: d["state"] == "paused")
        assert await viewer.ask("take_over") == "ack"
        await driver.event("introspection", lambda d: d["role"] == "viewer")
        assert (await driver.ask("resume"))["code"] == "not_driver"
        await driver.ask("take_over")
        await driver.close()
        back = await SessionClient(it.port).open(client=driver.id)
        assert back.id == driver.id
        assert back.named("introspection")[0]["role"] == "driver"
        await back.close()
        await viewer.close()


async def test_a_client_reconnects_before_its_lost_connection_is_noticed():
    async with manager() as it:
        lost = await SessionClient(it.port).open()
        await lost.ask("run", RUN)
        viewer = await SessionClient(it.port).open()
        back = await SessionClient(it.port).open(client=lost.id)
        assert back.id == lost.id
        assert back.named("introspection")[0]["role"] == "driver"
        await asyncio.wait_for(lost.control.wait_closed(), 60)
        assert lost.control.close_code == 4409
        assert await back.ask("pause") == "ack"
        await viewer.event("state-changed", lambda d: d["state"] == "paused")
        assert [d["role"] for d in viewer.named("introspection")] == ["viewer"]
        await back.close()
        await viewer.close()


async def test_a_session_without_clients_ends():
    async with manager(grace_s=0.3) as it:
        client = await SessionClient(it.port).open()
        await client.close()
        assert "grace" in await asyncio.wait_for(it.wait(), 60)


async def test_a_port_in_use_is_an_error():
    async with manager() as it:
        second = Manager(ManagerSettings(port=it.port, programs={}))
        with pytest.raises(OSError, match="in use"):
            await second.start()
        await second.close()


async def test_a_slow_client_gets_a_snapshot_in_place_of_a_backlog(monkeypatch):
    monkeypatch.setattr("executor.stream.outbox.MAX_MESSAGES", 5)
    outbox = ControlOutbox(lambda: b"snapshot")
    for n in range(20):
        outbox.put(b"event %d" % n, is_reply=False)
        if n == 3:
            outbox.put(b"reply", is_reply=True)
    assert [await outbox.take() for _ in range(2)] == [b"reply", b"snapshot"]
    outbox.put(b"event 20", is_reply=False)
    assert await outbox.take() == b"event 20"


async def test_only_the_latest_frame_of_a_stream_waits():
    outbox = StreamOutbox()
    for n in range(100):
        outbox.put("camera", b"camera %d" % n)
    outbox.put("scene", b"scene")
    assert [await outbox.take(), await outbox.take()] == [b"scene", b"camera 99"]
