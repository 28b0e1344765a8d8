"""Threads beside those of requests: work is done in turn, errors are passed on, and too much is refused."""

from __future__ import annotations

import asyncio
import threading
from typing import Any

import pytest

from backend.ingress import handler
from backend.ingress.handler import ThreadedHandler
from backend.language import views
from backend.workers.aside import Aside
from backend.workers.errors import BusyError
from tests.backend.ingress.test_bodies import head
from tests.backend.ingress.test_handler import body

pytestmark = pytest.mark.django_db(transaction=True)


def test_work_is_done_and_errors_arrive():
    aside = Aside("test", threads=2, per_owner=1, waiting=4)
    assert aside.ask("a", lambda: 6 * 7).result(60) == 42
    failed = aside.ask("a", lambda: 1 // 0)
    assert isinstance(failed.exception(60), ZeroDivisionError)


def test_one_owner_leaves_threads_to_the_others_and_too_much_is_refused():
    aside = Aside("test", threads=2, per_owner=1, waiting=2)
    go, begun = threading.Event(), threading.Event()

    def work():
        begun.set()
        return go.wait(60)

    first = aside.ask("a", work)
    assert begun.wait(60)
    second = aside.ask("a", work)  # waits for the first call, although a thread is free
    assert aside.ask("b", lambda: "done").result(60) == "done"
    with pytest.raises(BusyError):
        aside.ask("a", work)  # one owner can use at most half of the queue
    begun.clear()
    third = aside.ask("c", work)
    assert begun.wait(60)
    fourth = aside.ask("c", work)
    with pytest.raises(BusyError):
        aside.ask("d", work)
    go.set()
    assert all(future.result(60) for future in (first, second, third, fourth))


def test_a_formatter_that_hangs_holds_no_thread_of_requests(monkeypatch):
    """This is the case if the user has stopped their tools."""
    monkeypatch.setitem(handler.THREADS, "local", 1)
    go = threading.Event()
    monkeypatch.setattr(views, "checker", lambda user: lambda *_: (0, "[]") if go.wait(60) else (None, ""))
    handling = ThreadedHandler()

    async def ask(method, path, data=b""):
        sent, waiting = [], [body(data)]

        async def receive():
            return waiting.pop(0)

        async def send(message):
            sent.append(message)

        scope: Any = {"type": "http", "method": method, "path": f"/api/v1/{path}", "query_string": b""}
        await handling(scope | {"headers": head(content_length=str(len(data)))}, receive, send)
        return sent[0]["status"]

    async def many():
        hanging = [asyncio.ensure_future(ask("POST", "python/lint", b'{"source": "x"}')) for _ in range(10)]
        others = [await ask("GET", "projects") for _ in range(5)]
        assert not any(task.done() for task in hanging)
        go.set()
        return others, await asyncio.gather(*hanging)

    others, hanging = asyncio.run(many())
    assert set(others) == {200}
    assert set(hanging) == {200}
