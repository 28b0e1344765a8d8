import math

import pytest

from executor.world.simulation.pacing import FREE_RUN_STEPS, Pacer

STEP = 1 / 240


def test_steps_keep_up_with_real_time() -> None:
    pacer = Pacer(STEP)
    assert pacer.due(100.0) == 0
    total = sum(pacer.due(100.0 + i / 60) for i in range(1, 61))
    assert total == 240


def test_uneven_wake_ups_lose_nothing() -> None:
    pacer = Pacer(STEP)
    pacer.due(0.0)
    times = [0.013, 0.02, 0.061, 0.0611, 0.15, 0.2]
    assert sum(pacer.due(t) for t in times) == 48


@pytest.mark.parametrize(("speed", "steps"), [(0.5, 120), (2.0, 480), (10.0, 2400)])
def test_speed_scales_time(speed: float, steps: int) -> None:
    pacer = Pacer(STEP, speed)
    pacer.due(0.0)
    assert sum(pacer.due(i / 60) for i in range(1, 61)) == steps


def test_a_stall_is_not_caught_up() -> None:
    pacer = Pacer(STEP)
    pacer.due(0.0)
    assert pacer.due(5.0) == 24
    assert pacer.due(5.0 + 1 / 60) == 4


def test_a_pause_counts_for_nothing() -> None:
    pacer = Pacer(STEP)
    pacer.due(0.0)
    pacer.pause()
    assert pacer.due(50.0) == 0
    assert pacer.due(50.0 + 1 / 60) == 4


def test_free_running_always_has_work() -> None:
    pacer = Pacer(STEP, 0.0)
    assert [pacer.due(0.0), pacer.due(0.0)] == [FREE_RUN_STEPS] * 2
    assert pacer.next_due_s(0.0, 4) == 0.0


def test_it_returns_how_long_to_wait() -> None:
    pacer = Pacer(STEP)
    pacer.due(0.0)
    assert pacer.next_due_s(0.01, 4) == pytest.approx(4 / 240 - 0.01)
    assert pacer.next_due_s(1.0, 4) == 0.0


@pytest.mark.parametrize("speed", [-1.0, math.nan, math.inf])
def test_a_speed_that_is_none_is_refused(speed: float) -> None:
    with pytest.raises(ValueError, match="speed"):
        Pacer(STEP).set_speed(speed)
