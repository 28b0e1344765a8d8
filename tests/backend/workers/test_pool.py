"""The pool with real processes: its results, its limits, and the failures that it survives."""

from __future__ import annotations

import array
import fcntl
import os
import signal
import socket
import subprocess
import sys
import termios
import threading
import time
from concurrent.futures import wait
from pathlib import Path

import psutil
import pytest

from backend.config.environment import REPOSITORY
from backend.projects.documents.templates import files_of
from backend.workers.errors import BusyError, TookTooLongError, WorkFailedError
from backend.workers.pool import Limits, Pool

PATIENCE_S = 60
LARGE = 100_000
"""Bytes of a job that fit into the buffer of a socket."""


@pytest.fixture
def make_pool():
    made = []

    def make(
        *, workers=2, per_owner=2, waiting=8, deadline_s=PATIENCE_S, memory_bytes=1 << 30, too_long_kept_s=0.0
    ):
        limits = Limits(
            workers=workers,
            per_owner=per_owner,
            waiting=waiting,
            deadline_s=deadline_s,
            memory_bytes=memory_bytes,
            too_long_kept_s=too_long_kept_s,
        )
        made.append(Pool(limits))
        return made[-1]

    yield make
    for pool in made:
        pool.close()


def pack(pool, size, owner="someone"):
    """Returns work that takes longer the larger it is, and differs by its size."""
    return pool.ask(owner, "pack", files={"a": bytes(size)})


def pids(pool):
    return [worker._process.pid for worker in pool._workers if worker._process is not None]


def until(condition):
    gone = threading.Event()
    for _ in range(PATIENCE_S * 100):
        if condition():
            return
        gone.wait(0.01)
    raise AssertionError("it did not come about")


def test_a_project_is_checked_as_the_translator_checks_it(make_pool):
    import translator

    files = files_of("laser_bump_and_go")
    found = make_pool().ask("someone", "report", files=files).result(PATIENCE_S)
    project = translator.load(files)
    assert found["diagnostics"] == [d.to_json() for d in translator.check(project)]
    assert [action["name"] for action in found["actions"]] == list(project.actions)


def test_what_the_translator_refuses_is_an_answer(make_pool):
    found = make_pool().ask("someone", "xml", files={"project.json": b"{"}, self_contained=False)
    assert found.result(PATIENCE_S)["refused"][0]["severity"] == "error"


def test_the_same_question_is_answered_once(make_pool):
    pool = make_pool(workers=1)
    first = pack(pool, 10_000_000)
    assert pack(pool, 10_000_000, owner="another") is first
    result = first.result(PATIENCE_S)
    os.kill(pids(pool)[0], signal.SIGSTOP)  # the process could not answer again
    try:
        assert pack(pool, 10_000_000).result(0) == result
    finally:
        os.kill(pids(pool)[0], signal.SIGCONT)


def does(pool, number):
    """Asks for work until it is done: a busy machine may take over 3 s. What was late is not asked again."""
    end_s = time.monotonic() + PATIENCE_S
    while True:
        try:
            return pack(pool, number).result(PATIENCE_S)["zip"]
        except TookTooLongError:
            assert time.monotonic() < end_s
            number += 100


def test_work_that_takes_too_long_is_ended_and_the_next_is_done(make_pool):
    pool = make_pool(workers=1, deadline_s=3)
    does(pool, 1)
    os.kill(pids(pool)[0], signal.SIGSTOP)
    with pytest.raises(TookTooLongError, match="more than 3 s"):
        pack(pool, 2).result(PATIENCE_S)
    assert does(pool, 3)
    assert does(pool, 2)


def test_work_that_took_too_long_is_refused_at_once_for_a_while(make_pool):
    pool = make_pool(workers=1, deadline_s=3, too_long_kept_s=PATIENCE_S)
    does(pool, 1)
    os.kill(pids(pool)[0], signal.SIGSTOP)
    for _ in range(2):  # the second meets no process that is stopped
        with pytest.raises(TookTooLongError, match="more than 3 s"):
            pack(pool, 2).result(PATIENCE_S)
    assert does(pool, 3)


def whole_job_sent(pool):
    """Returns whether the socket to the one process holds a job of `LARGE` bytes that it has not read."""
    connection = pool._workers[0]._connection
    if connection is None:
        return False
    unread = array.array("i", [0])
    fcntl.ioctl(connection, termios.TIOCOUTQ, unread)
    return unread[0] > LARGE


def test_work_whose_worker_is_killed_from_outside_is_done_by_another_one(make_pool):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    [lost] = pids(pool)
    os.kill(lost, signal.SIGSTOP)
    asked = pack(pool, LARGE)
    until(lambda: whole_job_sent(pool))
    os.kill(lost, signal.SIGKILL)
    assert asked.result(PATIENCE_S)["zip"]


def test_work_whose_workers_are_killed_again_and_again_is_for_later(make_pool):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    [lost] = pids(pool)
    os.kill(lost, signal.SIGSTOP)
    asked = pack(pool, LARGE)
    until(lambda: whole_job_sent(pool))
    os.kill(lost, signal.SIGKILL)
    until(lambda: pids(pool) not in ([], [lost]))
    [second] = pids(pool)
    os.kill(second, signal.SIGSTOP)  # while it starts
    until(lambda: whole_job_sent(pool))
    os.kill(second, signal.SIGKILL)
    with pytest.raises(BusyError, match="from outside") as refused:
        asked.result(PATIENCE_S)
    assert (refused.value.status, refused.value.retry_after_s) == (503, 5)
    assert pack(pool, 2).result(PATIENCE_S)["zip"]


@pytest.mark.parametrize(
    ("end", "kind", "match"),
    [
        (signal.SIGSEGV, WorkFailedError, "made the process crash"),
        (signal.SIGALRM, TookTooLongError, f"more than {PATIENCE_S} s"),
    ],
)
def test_work_that_ends_its_worker_is_not_done_again(make_pool, end, kind, match):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    [lost] = pids(pool)
    os.kill(lost, signal.SIGSTOP)
    asked = pack(pool, LARGE)
    until(lambda: whole_job_sent(pool))
    os.kill(lost, end)
    os.kill(lost, signal.SIGCONT)
    with pytest.raises(kind, match=match):
        asked.result(PATIENCE_S)


def test_work_of_a_pool_that_is_closed_is_for_later(make_pool):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    os.kill(pids(pool)[0], signal.SIGSTOP)
    asked = pack(pool, LARGE)
    until(lambda: whole_job_sent(pool))
    waiting = pack(pool, 2)
    pool.close()
    for each in (asked, waiting):
        with pytest.raises(BusyError, match="stops"):
            each.result(PATIENCE_S)


def test_a_worker_that_is_killed_leaves_the_work_of_others_alone(make_pool):
    pool = make_pool(workers=2)
    wait([pack(pool, 1, "a"), pack(pool, 2, "b")])
    until(lambda: len(pids(pool)) == 2)
    lost, other = pids(pool)
    for pid in (lost, other):
        os.kill(pid, signal.SIGSTOP)  # each of the two has one job
    futures = [pack(pool, 10 + n, f"owner {n}") for n in range(6)]
    until(lambda: pool.waiting == 4)
    os.kill(other, signal.SIGCONT)
    until(lambda: sum(f.done() for f in futures) == 5)
    os.kill(lost, signal.SIGKILL)
    assert all(future.result(PATIENCE_S)["zip"] for future in futures)
    assert pack(pool, 99).result(PATIENCE_S)["zip"]


def test_a_worker_that_died_while_it_had_no_work_fails_none(make_pool):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    [lost] = pids(pool)
    os.kill(lost, signal.SIGKILL)
    until(lambda: psutil.Process(lost).status() == psutil.STATUS_ZOMBIE)
    assert pack(pool, 2).result(PATIENCE_S)["zip"]
    assert pids(pool) != [lost]


def test_work_that_needs_too_much_memory_fails_with_that_reason(make_pool):
    pool = make_pool(workers=1, memory_bytes=120 << 20)
    with pytest.raises(WorkFailedError, match="more than a worker may use: 120 MB of memory"):
        pool.ask("someone", "pack", files={"a": os.urandom(100 << 20)}).result(PATIENCE_S)
    assert pack(pool, 3).result(PATIENCE_S)["zip"]


def test_more_than_may_wait_is_refused_with_when_to_ask_again(make_pool):
    pool = make_pool(workers=1, waiting=2)
    pack(pool, 1).result(PATIENCE_S)
    os.kill(pids(pool)[0], signal.SIGSTOP)
    try:
        going = [pack(pool, 10)]
        until(lambda: pool.waiting == 0)
        going += [pack(pool, 11, "owner 1"), pack(pool, 12, "owner 2")]
        with pytest.raises(BusyError) as refused:
            pack(pool, 13, "owner 3")
        assert (refused.value.status, refused.value.retry_after_s) == (503, 5)
    finally:
        os.kill(pids(pool)[0], signal.SIGCONT)
    assert all(future.result(PATIENCE_S)["zip"] for future in going)


def test_one_owner_does_not_take_the_others_workers(make_pool):
    pool = make_pool(workers=3, per_owner=2, waiting=20)
    wait([pack(pool, 20_000_000 + n, f"owner {n}") for n in range(3)])
    until(lambda: len(pids(pool)) == 3)
    for pid in pids(pool):
        os.kill(pid, signal.SIGSTOP)  # no work ends
    hoarded = [pack(pool, 10 + n, "hoarder") for n in range(6)]
    until(lambda: pool.waiting == 4)
    others = pack(pool, 77, "another")
    until(lambda: pool.waiting == 4)  # the third worker was free for it
    for pid in pids(pool):
        os.kill(pid, signal.SIGCONT)
    assert all(future.result(PATIENCE_S)["zip"] for future in [others, *hoarded])


def test_a_worker_starts_without_the_frameworks_of_the_web_server():
    program = "import sys; from backend.workers import worker; print('django' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, cwd=REPOSITORY)
    assert done.stdout == b"False\n"


def test_workers_see_no_secret_and_end_with_the_pool(make_pool, monkeypatch):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    (pid,) = pids(pool)
    assert b"BT_STUDIO" not in Path(f"/proc/{pid}/environ").read_bytes()
    pool.close()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_a_worker_does_not_outlive_a_server_that_was_killed(make_pool):
    pool = make_pool(workers=1)
    pack(pool, 1).result(PATIENCE_S)
    worker = pool._workers[0]
    worker._connection.shutdown(socket.SHUT_RDWR)  # as the end of the process does
    assert worker._process.wait(PATIENCE_S) == 0
