"""The main thread is interrupted where it hangs."""

from __future__ import annotations

import os
import signal
from typing import Any

import pytest

from executor.application.locate import Locator
from executor.application.watchdog import Breaker, Interrupted
from executor.supervision.confine import INTERRUPT_SIGNAL

HANGS = "def update(kill):\n    kill()\n    return 1\n"


@pytest.fixture
def update() -> Any:
    before = signal.getsignal(INTERRUPT_SIGNAL)
    names: dict[str, Any] = {}
    exec(compile(HANGS, "actions/Go.py", "exec"), names)  # noqa: S102 - as the engine loads an action
    yield names["update"]
    signal.signal(INTERRUPT_SIGNAL, before)


def kill() -> None:
    os.kill(os.getpid(), INTERRUPT_SIGNAL)


def test_code_of_the_user_is_interrupted_with_its_place(update: Any) -> None:
    breaker = Breaker(Locator())
    breaker.arm()
    with pytest.raises(Interrupted) as interrupted:
        update(kill)
    assert interrupted.value.place.file == "actions/Go.py"
    assert breaker.is_interrupted


def test_nothing_is_interrupted_outside_of_it_or_when_it_is_disarmed(update: Any) -> None:
    breaker = Breaker(Locator())
    breaker.arm()
    kill()
    assert breaker.is_interrupted
    breaker.disarm()
    assert update(kill) == 1
