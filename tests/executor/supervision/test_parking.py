"""Threads that leave their spot while they wait, so that the main thread can fork."""

from __future__ import annotations

import threading

from executor.supervision.parking import Parking


def test_threads_that_wait_are_parked() -> None:
    parking = Parking()
    spots = [parking.spot(), parking.spot()]
    with parking.parked(1.0) as are_parked:
        assert are_parked
        assert all(spot.locked() for spot in spots)
    assert not any(spot.locked() for spot in spots)


def test_a_thread_that_works_is_not_waited_for_long() -> None:
    parking = Parking()
    free, busy = parking.spot(), parking.spot()
    with busy, parking.parked(0.01) as are_parked:
        assert not are_parked
    assert not free.locked()


def test_a_thread_continues_only_afterwards() -> None:
    parking = Parking()
    spot, done = parking.spot(), threading.Event()

    def work() -> None:
        with spot:
            done.set()

    with parking.parked(1.0):
        thread = threading.Thread(target=work)
        thread.start()
        assert not done.is_set()
    thread.join()
    assert done.is_set()


def test_a_copy_forgets_them() -> None:
    parking = Parking()
    parking.spot().acquire()
    parking.forget()
    with parking.parked(0.0) as are_parked:
        assert are_parked
