"""A parent and its workers, which are small programs here: only a worker that ends or hangs is replaced."""

from __future__ import annotations

import os
import signal
import socket
import sys
import textwrap

import pytest

from backend.config import parent
from backend.config.server import ServeError
from backend.core.processes.numbers import make_page
from backend.core.processes.siblings import PAGE

WORKER = """
    import mmap, os, struct, sys, threading, time
    folder, own = sys.argv[1:3]
    page = mmap.mmap(os.open(f"{folder}/worker-{own}.numbers", os.O_RDWR), 2048)
    life = os.open(f"{folder}/lives", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.write(life, own.encode())
    lives = open(f"{folder}/lives").read().count(own)
    def put(place, value):
        page[8 * place : 8 * place + 8] = struct.pack("d", value)
    def serve():
        put(0, 1)
        while True:
            put(1, time.monotonic())
            time.sleep(0.01)
    def wait_for_the_server():
        put(0, 1)
        while not os.path.exists(f"{folder}/server-ready"):
            put(1, time.monotonic())
            time.sleep(0.01)
"""


# The pool ends when its input closes.
ENDS = "threading.Thread(target=lambda: (sys.stdin.read(), os._exit(0)), daemon=True).start()\n"
POOL = "9"


class Small(parent.Parent):
    """A parent of workers, and a pool, that do what a few lines say."""

    def __init__(self, *lines, until="", pool="serve()"):
        self.ready, self.log, self._lines, self._until = 0, "", lines, until
        self._pool_lines = ENDS + pool
        with socket.socket() as listener:
            super().__init__(listener, len(lines), on_ready=self._note_ready)
            self._fd = listener

    def _note_ready(self):
        self.ready += 1
        (self.folder / "server-ready").touch()

    def _make_pool(self, folder):  # type: ignore[override]
        return self._child(folder, POOL, "pool", self._pool_lines)

    def _worker(self, folder, number):
        return self._child(folder, number, f"web worker {number}", self._lines[number])

    def _child(self, folder, number, name, lines):
        self.folder = folder
        page = make_page(folder / PAGE.format(number))
        script = textwrap.dedent(WORKER) + textwrap.dedent(lines)
        return parent.Child(name, [sys.executable, "-S", "-c", script, str(folder), str(number)], page)

    def _look(self, now_s, passed_s):
        super()._look(now_s, passed_s)
        lives = self.folder / "lives"
        self.log = lives.read_text() if lives.exists() else ""
        if self._until and all(self.log.count(own) >= self._until.count(own) for own in set(self._until)):
            os.kill(os.getpid(), signal.SIGTERM)


@pytest.fixture(autouse=True)
def _quick(monkeypatch):
    monkeypatch.setattr(parent, "TICK_S", 0.05)
    monkeypatch.setattr(parent, "FIRST_PAUSE_S", 0.01)
    monkeypatch.setattr(parent, "LONGEST_PAUSE_S", 0.02)


def test_who_dies_is_started_again_and_nobody_else(caplog):
    dies_twice = "wait_for_the_server(); lives < 3 and sys.exit(4); serve()"
    family = Small("serve()", dies_twice, until="0111")
    assert family.run() is signal.SIGTERM
    assert (family.ready, family.log.count("0"), family.log.count("1")) == (1, 1, 3)
    assert "web worker 1 ended with status 4 and is started again" in caplog.text


@pytest.mark.parametrize("how", ["time.sleep(1000)", "put(3, 1000); serve()"])
def test_who_hangs_is_replaced(monkeypatch, caplog, how):
    monkeypatch.setattr(parent, "HUNG_S", 3.0)  # on a busy machine, a program starts so much later
    family = Small("serve()", f"wait_for_the_server()\nif lives < 2:\n    {how}\nserve()", until="011")
    family.run()
    assert family.log.count("0") == 1
    assert "the web worker 1 hangs and is replaced" in caplog.text


def test_a_pool_that_hangs_is_replaced(monkeypatch, caplog):
    monkeypatch.setattr(parent, "HUNG_S", 3.0)
    family = Small(
        "serve()", until="099", pool="wait_for_the_server()\nif lives < 2:\n    time.sleep(1000)\nserve()"
    )
    family.run()
    assert (family.ready, family.log.count("0")) == (1, 1)
    assert "the pool hangs and is replaced" in caplog.text


def test_a_worker_that_cannot_start_ends_the_start(caplog):
    family = Small("serve()", "sys.exit(3)")
    with pytest.raises(ServeError, match="web worker 1 ended with status 3 before the server was ready"):
        family.run()
    assert family.ready == 0


def test_a_server_of_which_no_worker_starts_any_more_ends(caplog):
    once = "lives > 1 and sys.exit(3)\nwait_for_the_server()"
    with pytest.raises(
        ServeError, match="No web worker can start any more; the last one ended with status 3"
    ):
        Small(once, once).run()


def test_pauses_grow_to_a_bound(monkeypatch):
    monkeypatch.undo()
    pauses = [parent._pause_s(failures) for failures in range(1, 12)]
    assert pauses[:3] == [0.5, 1.0, 2.0]
    assert pauses == sorted(pauses)
    assert pauses[-1] == 30.0
