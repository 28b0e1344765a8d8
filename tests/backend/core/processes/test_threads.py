"""The fixed pool of threads: which thread works next, what callers receive, and how the threads end."""

from __future__ import annotations

import asyncio
import threading
import time
import weakref
from functools import partial

import pytest

from backend.core.processes.threads import Threads


@pytest.fixture
def threads():
    made = Threads(3, "test")
    yield made
    made.end()


def name():
    return threading.current_thread().name


def test_the_one_that_worked_last_works_next(threads):
    async def ask():
        loop = asyncio.get_running_loop()
        gate = threading.Barrier(3)
        await asyncio.gather(*(threads.run(loop, gate.wait) for _ in range(3)))
        last = await threads.run(loop, name)
        return [await threads.run(loop, name) for _ in range(5)] == [last] * 5

    assert asyncio.run(ask())


def test_there_are_never_more_and_nothing_is_left_undone(threads):
    async def ask():
        loop = asyncio.get_running_loop()
        return await asyncio.gather(*(threads.run(loop, lambda n=n: (n, name())) for n in range(200)))

    done = asyncio.run(ask())
    assert [n for n, _ in done] == list(range(200))
    assert {worker for _, worker in done} <= {"test_0", "test_1", "test_2"}


def test_one_owner_has_a_share_and_the_others_find_a_free_thread():
    threads = Threads(4, "test", per_owner=2)
    gates = {name: threading.Event() for name in ("greedy", "other")}

    async def ask():
        loop = asyncio.get_running_loop()
        greedy = [threads.run(loop, gates["greedy"].wait, "greedy") for _ in range(20)]
        other = [threads.run(loop, gates["other"].wait, "other") for _ in range(2)]
        assert (threads.full_for_s(), len(threads._waiting)) == (pytest.approx(0, abs=60), 18)
        gates["other"].set()
        await asyncio.gather(*other)
        # Two threads are free again, but not for the owner who has too many calls.
        assert await asyncio.gather(*(threads.run(loop, partial(int, n), f"user {n}") for n in range(9)))
        assert await threads.run(loop, lambda: "nobody's") == "nobody's"
        assert (len(threads._waiting), threads.full_for_s()) == (18, 0.0)
        gates["greedy"].set()
        return await asyncio.gather(*greedy)

    assert asyncio.run(ask()) == [True] * 20
    threads.end()


def test_an_error_comes_back_and_the_thread_works_on(threads):
    async def ask():
        loop = asyncio.get_running_loop()
        with pytest.raises(ZeroDivisionError):
            await threads.run(loop, lambda: 1 / 0)
        return await threads.run(loop, lambda: "well")

    assert asyncio.run(ask()) == "well"


def test_what_nobody_waits_for_any_more_does_no_harm(threads):
    async def leave(begun, gate):
        future = threads.run(asyncio.get_running_loop(), lambda: begun.set() or gate.wait())
        await asyncio.to_thread(begun.wait)
        return future.cancel()

    begun, gate = threading.Event(), threading.Event()
    assert asyncio.run(leave(begun, gate))
    gate.set()  # its loop is closed by now

    async def ask():
        return await threads.run(asyncio.get_running_loop(), name)

    assert asyncio.run(ask()).startswith("test_")


def test_the_end_waits_for_what_is_begun():
    threads, done = Threads(1, "test"), []
    begun, gate = threading.Event(), threading.Event()

    async def ask():
        threads.run(asyncio.get_running_loop(), lambda: (begun.set(), gate.wait(), done.append(1)))
        await asyncio.to_thread(begun.wait)

    asyncio.run(ask())
    threading.Timer(0.05, gate.set).start()
    threads.end()
    assert done == [1]


def test_it_tells_for_how_long_no_thread_was_free_and_none_made_progress(threads, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])

    async def ask():
        loop = asyncio.get_running_loop()
        gates = [threading.Event() for _ in range(4)]
        first, second, third, fourth = (threads.run(loop, gate.wait) for gate in gates)
        assert (threads.full_for_s(), threads.stuck_for_s()) == (0.0, 0.0)
        now[0] += 10
        assert (threads.full_for_s(), threads.stuck_for_s()) == (10.0, 10.0)
        gates[0].set()  # the fourth takes the thread of the first
        await first
        now[0] += 5
        assert (threads.full_for_s(), threads.stuck_for_s()) == (15.0, 5.0)
        for gate in gates:
            gate.set()
        await asyncio.gather(second, third, fourth)
        return threads.full_for_s(), threads.stuck_for_s()

    assert asyncio.run(ask()) == (0.0, 0.0)


def test_nothing_of_a_call_stays_with_a_thread_that_waits(threads):
    class Large:
        """Stands for the data of a request or of its answer."""

    async def ask():
        loop = asyncio.get_running_loop()
        given, made = Large(), Large()
        kept = [weakref.ref(given), weakref.ref(made)]
        await threads.run(loop, lambda given=given, made=made: (given, made)[1])
        del given, made
        while any(one() is not None for one in kept):  # noqa: ASYNC110 - the thread lets go after its caller knows
            await asyncio.sleep(0.01)

    asyncio.run(ask())
