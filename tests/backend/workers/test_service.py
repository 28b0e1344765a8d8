"""One pool for several web workers: used over a socket, with the same answers and limits."""

from __future__ import annotations

import socket
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from backend.core.processes.numbers import BEAT, STARTED, make_page
from backend.workers import service
from backend.workers.errors import BusyError, TookTooLongError, WorkFailedError
from backend.workers.pool import Limits, Pool
from backend.workers.remote import RemotePool
from tests.backend.workers.test_pool import PATIENCE_S

FILES = {"project.json": b'{"format": "bt-studio/project", "version": 1, "name": "P", "main_tree": "main"}'}


class Served:
    """A pool behind a socket, and two clients."""

    def __init__(self, path, **limits):
        self.pool = Pool(Limits(**{
            "workers": 2, "per_owner": 2, "waiting": 8, "deadline_s": 60, "memory_bytes": 1 << 30,
        } | limits))  # fmt: skip
        self.listener = service.listening(path)
        threading.Thread(target=service.serve, args=(self.listener, self.pool), daemon=True).start()
        self.askers = [RemotePool(path), RemotePool(path)]

    def close(self):
        self.listener.shutdown(socket.SHUT_RDWR)  # this wakes the thread that accepts
        self.listener.close()
        self.pool.close()


@pytest.fixture
def served():
    """Makes pools that are asked over a socket."""
    made: list[Any] = []
    with tempfile.TemporaryDirectory() as folder:

        def make(**limits):
            made.append(Served(Path(folder) / f"{len(made)}.sock", **limits))
            return made[-1]

        yield make
        for each in made:
            each.close()


def test_all_askers_get_what_the_pool_says(served):
    one, two = served().askers
    asked = [asker.ask("someone", "report", files=FILES) for asker in (one, two, one)]
    reports = [future.result(PATIENCE_S) for future in asked]
    assert reports[0] == reports[1] == reports[2]
    assert reports[0]["diagnostics"]
    assert one.waiting == two.waiting == 0


def test_errors_come_as_what_they_are(served):
    late, _ = served(deadline_s=0.001).askers
    with pytest.raises(TookTooLongError, match="more than"):
        late.ask("someone", "report", files=FILES).result(PATIENCE_S)
    faulty, _ = served().askers
    with pytest.raises(WorkFailedError, match="fault of BT Studio"):
        faulty.ask("someone", "no such job").result(PATIENCE_S)


def test_what_waits_is_bounded_for_all_together(served):
    one, two = served(waiting=0).askers
    for asker in (one, two):
        with pytest.raises(BusyError, match="too much to translate"):
            asker.ask("someone", "report", files=FILES).result(PATIENCE_S)


def test_without_a_pool_the_server_is_busy_until_there_is_another(served, tmp_path):
    asker = RemotePool(tmp_path / "none.sock")
    with pytest.raises(BusyError, match="started again"):
        asker.ask("someone", "report", files=FILES)
    assert asker.waiting == 0


def test_the_pool_reports_that_it_can_be_asked(served, tmp_path):
    page = make_page(tmp_path / "page")
    threading.Thread(target=service.beat, args=(served().pool, page), daemon=True).start()
    deadline_s = time.monotonic() + PATIENCE_S
    while not page[STARTED]:
        assert time.monotonic() < deadline_s
        time.sleep(0.01)
    assert page[BEAT] <= time.monotonic()
