"""Executors that are alive but do not answer are detected and ended; their sessions fail with the reason."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
import threading
from types import SimpleNamespace
from typing import Any
from uuid import uuid4

import psutil
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.protocol import State

from backend.sessions import maintenance, watch
from backend.sessions.consumers import EXECUTOR_SILENT, _is_ping, _noting
from backend.sessions.lifecycle import writes
from backend.sessions.manager import sockets
from backend.sessions.models import Session
from tests.backend.sessions.conftest import spec
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.backend.sessions.test_consumers import opened, relay, session  # noqa: F401 - fixtures
from tests.executor.manager.test_gate import gate  # noqa: F401 - a fixture
from tests.executor.session_client import TOKEN, manager_process


@pytest.fixture
def quick(monkeypatch):
    """Gives up sooner. Use it only for managers that do not answer: a busy machine is delayed for longer."""
    monkeypatch.setattr(watch, "PING_EVERY_S", 0.1)
    monkeypatch.setattr(watch, "NOTED_S", 0.3)
    monkeypatch.setattr(watch, "longest_s", lambda: 1.0)


def test_silence_is_counted_until_an_answer_comes():
    silence = watch.Silence()
    for _ in range(4):
        silence.passed(1.0)
    assert silence.seconds == 4.0
    silence.heard()
    assert silence.seconds == 0.0


def test_our_own_lateness_is_no_silence_of_others():
    silence = watch.Silence()
    silence.heard()
    silence.passed(600.0)
    assert silence.seconds == watch.PING_EVERY_S


def test_who_was_never_reached_from_here_is_not_given_up():
    silence = watch.Silence()
    silence.not_reached()
    for _ in range(20):
        silence.passed(1.0)
    assert silence.seconds == 0.0
    silence.heard()
    silence.not_reached()
    silence.passed(1.0)
    assert silence.seconds == 1.0, "it has closed its socket, and still runs"


def test_the_pings_of_a_page_do_not_count_as_use():
    assert _is_ping(b'{"id":"c7","command":"ping","data":{}}')
    assert not _is_ping(b'{"id":"c7","command":"pause","data":{}}')
    assert not _is_ping(json.dumps({"id": "c7", "command": "run", "data": "x" * 200}).encode())
    assert not _is_ping(b"")


async def test_a_page_that_pings_alone_lets_its_session_become_idle():
    session_id, messages = uuid4(), iter([b'{"id":"a","command":"ping"}', b'{"id":"b","command":"pause"}'])

    async def receive():
        return {"type": "websocket.receive", "bytes": next(messages)}

    noted = _noting(session_id, receive)
    await noted()
    assert session_id not in maintenance.attendance.take_used()
    await noted()
    assert session_id in maintenance.attendance.take_used()


def row(address, token=TOKEN, monkeypatch=None):
    """Returns the row of a session whose executor has this address and token."""
    monkeypatch.setattr(writes, "manager_token", lambda _: token)
    return SimpleNamespace(id=uuid4(), address=address)


@contextlib.asynccontextmanager
async def watched(one):
    task = asyncio.create_task(watch.until_silent(one))
    yield task
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)


async def test_a_stopped_manager_behind_the_gate_is_given_up(gate, quick, monkeypatch):  # noqa: F811
    gate.door.open()
    async with manager_process("--gate", str(gate.entrance), "--session", "s1") as process:
        one = row(f"unix:{gate.path}", monkeypatch=monkeypatch)
        os.kill(process.pid, signal.SIGSTOP)
        try:
            async with watched(one) as task:
                await asyncio.wait_for(task, 60)
        finally:
            os.kill(process.pid, signal.SIGCONT)


async def test_a_manager_that_stops_is_given_up_without_its_answer_to_the_closing(quick, monkeypatch):
    monkeypatch.setattr(sockets, "CLOSING_S", 3600)
    async with manager_process() as process:
        one = row(f"127.0.0.1:{process.ready['port']}", monkeypatch=monkeypatch)
        silences = []
        known = watch.Silence
        monkeypatch.setattr(watch, "Silence", lambda: silences.append(known()) or silences[-1])
        async with watched(one) as task:
            await until(lambda: silences and silences[0]._was_heard)
            os.kill(process.pid, signal.SIGSTOP)
            try:
                await until(task.done)
            finally:
                os.kill(process.pid, signal.SIGCONT)


async def test_a_manager_that_answers_again_in_time_is_kept(monkeypatch):
    monkeypatch.setattr(watch, "PING_EVERY_S", 0.1)
    async with manager_process() as process:
        one = row(f"127.0.0.1:{process.ready['port']}", monkeypatch=monkeypatch)
        silences = []
        known = watch.Silence
        monkeypatch.setattr(watch, "Silence", lambda: silences.append(known()) or silences[-1])
        async with watched(one) as task:
            for _ in range(2):
                await until(lambda: silences and silences[0]._was_heard and silences[0].seconds <= 0.2)
                os.kill(process.pid, signal.SIGSTOP)
                await until(lambda: silences[0].seconds > 1.0)
                os.kill(process.pid, signal.SIGCONT)
            await until(lambda: silences[0].seconds <= 0.2)
            assert not task.done()


async def until(condition):
    async with asyncio.timeout(60):
        while not condition():  # noqa: ASYNC110
            await asyncio.sleep(0.02)


@pytest.mark.parametrize(("kind", "is_given_up"), [("deaf", True), ("old", False), ("echo", False)])
async def test_what_counts_as_an_answer(kind, is_given_up, launcher_of, quick, monkeypatch):
    started = await asyncio.to_thread(launcher_of(kind).start, spec())
    if not is_given_up:
        monkeypatch.setattr(watch, "longest_s", lambda: 5.0)
    heard = []
    monkeypatch.setattr(
        watch.Silence, "heard", lambda self, before=watch.Silence.heard: (heard.append(1), before(self))
    )
    async with watched(row(started.address, monkeypatch=monkeypatch)) as task:
        if is_given_up:
            await asyncio.wait_for(task, 60)
            assert heard == []
        else:
            await until(lambda: len(heard) > 5)
            assert not task.done()


class Breaking:
    """A connection whose ping fails, or that closes and would hold the task that pings it."""

    def __init__(self, state):
        self.state, self.pings = state, 0

    async def __aenter__(self):
        return self

    async def __aexit__(self, *_):
        pass

    async def wait_closed(self):
        await asyncio.Event().wait()

    async def ping(self):
        self.pings += 1
        raise RuntimeError("no ping")

    @property
    def transport(self):
        return SimpleNamespace(abort=lambda: None)


async def test_a_socket_that_fails_or_closes_does_not_hold_the_watch_of_others(quick, monkeypatch, caplog):
    failing, closing = opened_one_after_another = [Breaking(State.OPEN), Breaking(State.CLOSING)]
    monkeypatch.setattr(watch, "manager_socket", lambda *_: opened_one_after_another.pop(0))
    one: Any = SimpleNamespace(id=uuid4())
    async with watched(one) as first, watched(one) as second, asyncio.timeout(60):
        await asyncio.gather(first, second)
    assert "was not asked" in caplog.text
    assert failing.pings > 0
    assert closing.pings == 0


@pytest.mark.django_db(transaction=True)
@pytest.mark.parametrize("how", ["stopped", "hangs"])
@pytest.mark.usefixtures("quick")
def test_a_page_gets_the_reason_and_another_run_starts_another_executor(how, relay, session, api, project):  # noqa: F811
    started = session("echo")
    launched(started["id"])
    pid = Session.objects.get().launcher_state["pid"]
    with opened(relay, started["control_url"]) as socket:
        socket.recv()
        if how == "hangs":
            socket.send("hang")
        else:
            os.kill(pid, signal.SIGSTOP)
        with pytest.raises(ConnectionClosed):
            socket.recv()
        assert (socket.close_code, socket.close_reason) == (EXECUTOR_SILENT, watch.why())
    assert not psutil.pid_exists(pid)
    failed = api.get(f"sessions/{started['id']}")
    assert (failed["state"], failed["error"]) == ("failed", watch.why())
    again = api.post(f"projects/{project['id']}/session")
    assert again["id"] != started["id"]
    launched(again["id"])
    assert api.get(f"sessions/{again['id']}")["state"] == "ready"


@pytest.mark.django_db(transaction=True)
def test_a_session_without_a_page_is_looked_after_by_every_server_and_failed_once(session, quick, api):  # noqa: F811
    started = session("echo")
    launched(started["id"])
    pid = Session.objects.get().launcher_state["pid"]
    os.kill(pid, signal.SIGSTOP)

    async def two_servers():
        servers = [watch.Watchmen(), watch.Watchmen()]
        ready = await asyncio.to_thread(maintenance.ready_sessions)
        for server in servers:
            server.keep_to(ready)
            server.keep_to(ready)
        tasks = [task for server in servers for task in server._tasks.values()]
        assert len(tasks) == 2
        await asyncio.wait_for(asyncio.gather(*tasks), 60)

    thread = threading.Thread(target=lambda: asyncio.run(two_servers()))
    thread.start()
    thread.join()
    failed = api.get(f"sessions/{started['id']}")
    assert (failed["state"], failed["error"]) == ("failed", watch.why())
    assert not psutil.pid_exists(pid)


@pytest.mark.django_db(transaction=True)
def test_the_first_who_sees_the_end_gives_the_reason_for_it(session, api, monkeypatch):  # noqa: F811
    started = session("echo")
    launched(started["id"])
    launcher = writes.launcher()
    stop = launcher.stop

    def stop_and_be_seen(state, *, timeout_s):
        stop(state, timeout_s=timeout_s)
        monkeypatch.setattr(launcher, "stop", stop)
        maintenance.maintain()

    monkeypatch.setattr(launcher, "stop", stop_and_be_seen)
    writes.fail_session(Session.objects.get().id, watch.why())
    failed = api.get(f"sessions/{started['id']}")
    assert (failed["state"], failed["error"]) == ("failed", watch.why())


@pytest.mark.django_db(transaction=True)
def test_a_session_that_was_ended_meanwhile_stays_ended(session, api):  # noqa: F811
    started = session("echo")
    launched(started["id"])
    api.delete(f"sessions/{started['id']}")
    writes.fail_session(Session.objects.get().id, watch.why())
    assert api.get(f"sessions/{started['id']}")["state"] == "ended"


async def test_nobody_looks_after_what_has_ended():
    keeper = watch.Watchmen()
    one: Any = SimpleNamespace(id=uuid4(), address="127.0.0.1:9")
    keeper.keep_to([one])
    (task,) = keeper._tasks.values()
    keeper.keep_to([])
    await asyncio.wait([task], timeout=60)
    assert task.cancelled()
    assert keeper._tasks == {}
