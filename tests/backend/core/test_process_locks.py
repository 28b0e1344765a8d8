"""Locks of this process: all on one connection, and others wait for them."""

from __future__ import annotations

import threading
import time

import pytest
from django.db import connection, transaction

from backend.core import process_locks
from backend.core.locks import lock_number, transaction_lock
from backend.core.process_locks import held_by_process
from tests.deadline import DEADLINE_S, wait_until

pytestmark = pytest.mark.django_db(transaction=True)


@pytest.fixture(autouse=True)
def holder(monkeypatch):
    made = process_locks.Holder()
    monkeypatch.setattr(process_locks, "holder", made)
    yield made
    made._drop()


def is_postgresql():
    return connection.vendor == "postgresql"


def connections():
    with connection.cursor() as cursor:
        cursor.execute("SELECT count(*) FROM pg_stat_activity WHERE datname = current_database()")
        return cursor.fetchone()[0]


def is_free(name):
    with connection.cursor() as cursor:
        cursor.execute("SELECT pg_try_advisory_xact_lock(%s)", [lock_number(name)])
        return cursor.fetchone()[0]


def settled_connections():
    """Returns the number of connections once it stays the same: a server closes ended ones a bit later."""
    end_s, before = time.monotonic() + DEADLINE_S, -1
    while time.monotonic() < end_s:
        if (now := connections()) == before:
            return now
        before = now
        time.sleep(0.2)
    raise AssertionError("the number of connections changes all the time")


def test_many_locks_take_one_connection_and_are_released_one_by_one():
    if not is_postgresql():
        with held_by_process("a"), held_by_process("a"):
            return
    before = settled_connections()
    with held_by_process("a"):
        with held_by_process("b"), held_by_process("c"):
            assert settled_connections() == before + 1
            assert [is_free(name) for name in "abcd"] == [False, False, False, True]
        assert [is_free(name) for name in "abc"] == [False, True, True]
    assert is_free("a")


def test_a_transaction_that_holds_the_lock_is_waited_for():
    order = []
    taken = threading.Event()

    def wait():
        with held_by_process("a"):
            order.append("process")
        taken.set()
        connection.close()

    with transaction.atomic():
        transaction_lock("a")
        waiting = threading.Thread(target=wait)
        if is_postgresql():
            waiting.start()
        order.append("transaction")
    if not is_postgresql():
        waiting.start()
    waiting.join()
    assert order == ["transaction", "process"]


def test_a_lost_connection_is_replaced(holder):
    if not is_postgresql():
        with held_by_process("a"):
            assert holder._connection is None
        return
    with held_by_process("a"):
        holder._connection.connection.close()
    with held_by_process("a"):
        assert not is_free("a")
        holder._connection.connection.close()
        with held_by_process("b"):
            assert not is_free("b")
    # The server frees it once it has read that the connection is closed.
    wait_until(lambda: is_free("a"), "the lock that was lost is free")
