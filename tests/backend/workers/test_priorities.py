"""Small jobs beside large ones: each kind has its own processes and priority."""

from __future__ import annotations

import os
import signal
from dataclasses import replace

import pytest

from backend.workers.pool import Limits, Pool
from backend.workers.priorities import SMALL_BYTES, Pools
from tests.backend.workers.test_pool import PATIENCE_S, pack, pids, until

LIMITS = Limits(workers=1, per_owner=1, waiting=4, deadline_s=PATIENCE_S, memory_bytes=1 << 30)


@pytest.fixture
def small():
    pool = Pool(LIMITS)
    yield pool
    pool.close()


@pytest.fixture
def large():
    pool = Pool(replace(LIMITS, niceness=7))
    yield pool
    pool.close()


def test_the_size_of_the_question_chooses_the_pool(small, large):
    pools = Pools(small, large)
    assert pack(pools, 1000).result(PATIENCE_S)["zip"]
    assert (len(pids(small)), len(pids(large))) == (1, 0)
    assert pack(pools, 2 * SMALL_BYTES).result(PATIENCE_S)["zip"]
    assert (len(pids(small)), len(pids(large))) == (1, 1)


def test_large_work_gives_way_and_small_work_does_not(small, large):
    pools = Pools(small, large)
    for size in (1000, 2 * SMALL_BYTES):
        pack(pools, size).result(PATIENCE_S)
    own = os.getpriority(os.PRIO_PROCESS, 0)
    assert os.getpriority(os.PRIO_PROCESS, pids(small)[0]) == own
    assert os.getpriority(os.PRIO_PROCESS, pids(large)[0]) == min(19, own + 7)


def test_small_work_does_not_wait_for_large_work_of_the_same_user(small, large):
    pools = Pools(small, large)
    pack(pools, SMALL_BYTES).result(PATIENCE_S)
    (process,) = pids(large)
    os.kill(process, signal.SIGSTOP)
    try:
        held = [pack(pools, SMALL_BYTES * 2)]
        until(lambda: not large.waiting)
        held += [pack(pools, SMALL_BYTES * number) for number in (3, 4)]
        assert pack(pools, 1000).result(PATIENCE_S)["zip"]
        assert not any(future.done() for future in held)
        assert pools.waiting == 2
    finally:
        os.kill(process, signal.SIGCONT)
    assert all(future.result(PATIENCE_S)["zip"] for future in held)
