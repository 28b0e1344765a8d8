"""`bt-studio serve`, as a process."""

from __future__ import annotations

import json
import signal
import socket
import sqlite3
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path

import psutil
import psycopg
import pytest
import requests
from django.db import OperationalError
from websockets.sync.client import connect

from backend.config.server import ServeError, await_database, data_folder, make_data_folder, migrate
from tests.backend.serving import serving, start

ROOT = Path(__file__).resolve().parents[3]


def failed(process):
    """Returns exit status and stderr of a server that did not start."""
    _, said = process.communicate(timeout=60)
    return process.returncode, said


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    """A server that several tests use, with its data folder."""
    folder = tmp_path_factory.mktemp("served")
    with serving(folder, is_migrated=False, BT_STUDIO_TOKEN="") as server:
        yield folder, server


def test_a_server_serves_and_ends_cleanly(tmp_path, running):
    with serving(tmp_path) as server:
        assert server.token
        assert running[1].token
        assert server.token != running[1].token
        me = requests.get(f"{server.base}/api/v1/me", headers=server.headers, timeout=60)
        assert me.json()["mode"] == "local"
        browser = requests.Session()
        page = browser.get(f"{server.base}/?token={server.token}", timeout=60)
        assert "token" not in page.url
        assert browser.get(f"{server.base}/api/v1/projects", timeout=60).json()["items"] == []
        made = browser.post(
            f"{server.base}/api/v1/projects", json={"name": "P"}, headers={"Origin": server.base}, timeout=60
        )
        assert made.status_code == 201
        session = browser.post(
            f"{server.base}/api/v1/projects/{made.json()['id']}/session", timeout=60
        ).json()
        assert session["state"] in {"starting", "ready"}
        control = "ws" + server.base.removeprefix("http") + session["control_url"]
        with connect(control, additional_headers=server.headers, proxy=None, open_timeout=60) as socket_:
            socket_.recv(timeout=60)
            family = psutil.Process(server.process.pid).children(recursive=True)
            assert server.end(signal.SIGINT) == 0
        out, err = server.output
        assert server.token in out
        assert "Traceback" not in err
        _, alive = psutil.wait_procs(family, timeout=60)
        assert [p for p in alive if p.status() != psutil.STATUS_ZOMBIE] == []


def test_an_interrupt_that_python_would_drop_ends_a_server_that_starts():
    """An exception in the callback of a weak reference is printed and dropped."""
    script = """
import os, signal, weakref
from backend.config.server import ended_by_interrupt
class Module: pass
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job ignores it
module = Module()
watch = weakref.ref(module, lambda _: (os.kill(os.getpid(), signal.SIGINT), sum(range(10_000))))
{}:
    del module
print("serves")
"""

    def ended(guard):
        done = subprocess.run(
            [sys.executable, "-c", script.format(guard)],
            cwd=ROOT,
            check=False,
            capture_output=True,
            text=True,
            timeout=60,
        )
        return done.returncode, done.stdout

    assert ended("if True") == (0, "serves\n")
    assert ended("with ended_by_interrupt()") == (-signal.SIGINT, "")


def test_the_database_is_in_wal_and_files_are_private(running):
    folder, server = running
    database = sqlite3.connect(folder / "bt-studio.sqlite3")
    assert database.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    database.close()
    ready = folder / "ready.json"
    for private in (folder / "secret_key", ready):
        assert stat.S_IMODE(private.stat().st_mode) == 0o600
    assert json.loads(ready.read_text())["pid"] == server.process.pid


def test_a_second_server_on_the_same_data_is_refused(running):
    folder, server = running
    status, said = failed(start(folder, "--port", "0"))
    assert status == 1
    assert str(server.process.pid) in said
    assert "--data-dir" in said


def test_servers_that_share_a_data_folder_are_let_in_together_and_no_other_with_them(tmp_path):
    def let_in(**options):
        with ExitStack() as inner:
            inner.enter_context(data_folder(tmp_path, **options))

    with data_folder(tmp_path, is_shared=True):
        let_in(is_shared=True)
        with pytest.raises(ServeError, match="Another server uses"):
            let_in()
    with data_folder(tmp_path), pytest.raises(ServeError, match=r"Another server \(process"):
        let_in(is_shared=True)


def test_servers_that_start_together_have_one_secret_key(tmp_path):
    folders = [tmp_path / str(number) for number in range(20)]
    for folder in folders:
        with ThreadPoolExecutor(4) as servers:

            def started(_, folder=folder):
                make_data_folder(folder)
                return (folder / "secret_key").read_text()

            keys = set(servers.map(started, range(4)))
        assert len(keys) == 1
        assert len(keys.pop()) == 64
        assert [path.name for path in folder.iterdir()] == ["secret_key"]


def test_a_port_in_use_is_one_sentence_with_the_remedy(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        status, said = failed(start(tmp_path, "--port", port))
    assert status == 1
    assert (
        said
        == f"Port {port} is already in use: end the program that uses it, or choose another with --port.\n"
    )


@pytest.mark.parametrize("host", ["0.0.0.0", "example.org"])  # noqa: S104
def test_other_machines_are_not_served_without_accounts(tmp_path, host):
    status, said = failed(start(tmp_path, "--host", host, "--port", "0"))
    assert status == 1
    assert host in said
    assert said.count("\n") == 1


def test_several_workers_are_refused_on_localhost(tmp_path):
    status, said = failed(start(tmp_path, "--port", "0", "--workers", "2"))
    assert status == 1
    assert "BT_STUDIO_MODE=team" in said
    assert said.count("\n") == 1


def test_a_wrong_setting_is_named(tmp_path):
    status, said = failed(start(tmp_path, BT_STUDIO_SESSION_START_TIMEOUT_S="soon"))
    assert status == 2
    assert "BT_STUDIO_SESSION_START_TIMEOUT_S" in said
    assert "Traceback" not in said


def test_a_data_folder_that_cannot_be_written_is_reported(tmp_path):
    (tmp_path / "file").write_text("")
    status, said = failed(start(tmp_path / "file", "--port", "0"))
    assert status == 1
    assert said.count("\n") == 1


class Database:
    """A PostgreSQL that refuses some connections."""

    def __init__(self, *refusals):
        self.refusals = list(refusals)

    def connect(self, url, **_):
        if self.refusals:
            raise psycopg.OperationalError(self.refusals.pop(0))
        return self

    def close(self):
        self.is_closed = True


def test_a_database_that_starts_at_the_same_time_is_waited_for(monkeypatch):
    late = Database("connection failed: Connection refused", "FATAL:  the database system is starting up")
    monkeypatch.setattr("psycopg.connect", late.connect)
    await_database("postgresql://db/studio")
    assert late.refusals == []
    assert late.is_closed


def test_a_data_folder_that_cannot_be_written_ends_the_start_with_a_sentence(tmp_path, monkeypatch):
    (tmp_path / "secret_key").write_text("k" * 40)
    (tmp_path / "serve.lock").mkdir()  # it cannot be opened, also by root
    with pytest.raises(ServeError, match=f"The data folder {tmp_path} cannot be used"), data_folder(tmp_path):
        pass


def test_a_database_that_cannot_be_written_ends_the_start_with_a_sentence(monkeypatch):
    def refused(*_, **__):
        raise OperationalError("attempt to write a readonly database")

    monkeypatch.setattr("django.core.management.call_command", refused)
    monkeypatch.setattr("backend.config.server.await_database", lambda _: None)
    with pytest.raises(ServeError, match="cannot be used: attempt to write a readonly database"):
        migrate()


@pytest.mark.parametrize(
    ("patience_s", "refusal"),
    [(60, 'FATAL:  password authentication failed for user "studio"'), (0, "Connection refused")],
)
def test_a_database_that_does_not_want_us_ends_the_start(monkeypatch, patience_s, refusal):
    monkeypatch.setattr("psycopg.connect", Database(refusal, refusal).connect)
    with pytest.raises(ServeError, match=f"BT_STUDIO_DATABASE_URL cannot be used: {refusal}"):
        await_database("postgresql://db/studio", patience_s)
