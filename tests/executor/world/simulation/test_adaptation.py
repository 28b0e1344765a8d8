"""A client too slow for its pictures gets smaller ones, and better ones again as soon as possible."""

from executor.world.simulation.adaptation import (
    CAMERA_SHARES,
    FIRST_PATIENCE,
    LEVELS,
    LONGEST_PATIENCE,
    Adaptation,
    CameraRates,
    Level,
    ViewSize,
)


def after(adaptation: Adaptation[Level], *losses: float) -> int:
    for lost in losses:
        adaptation.note(lost)
    return LEVELS.index(adaptation.level)


def test_it_goes_down_at_once_and_up_with_patience() -> None:
    adaptation = Adaptation(LEVELS)
    assert after(adaptation) == 0
    assert after(adaptation, 0.9, 0.5) == 2
    assert after(adaptation, *[0.0] * (FIRST_PATIENCE - 1)) == 2
    assert after(adaptation, 0.0) == 1
    assert after(adaptation, *[0.0] * FIRST_PATIENCE) == 0


def test_a_single_frame_lost_changes_nothing() -> None:
    assert after(Adaptation(LEVELS), 0.1, 0.1, 0.2) == 0


def test_the_last_level_is_the_last() -> None:
    assert after(Adaptation(LEVELS), *[1.0] * 20) == len(LEVELS) - 1


def test_it_does_not_swing_where_the_better_level_is_too_much() -> None:
    adaptation = Adaptation(LEVELS)
    after(adaptation, 1.0)
    waits = []
    for _ in range(7):
        quiet = 0
        while LEVELS.index(adaptation.level) == 1:
            adaptation.note(0.0)
            quiet += 1
        waits.append(quiet)
        adaptation.note(1.0)
    assert waits[:4] == [FIRST_PATIENCE * 2**i for i in range(4)]
    assert waits[-1] == LONGEST_PATIENCE


def test_each_level_is_less_than_the_one_before() -> None:
    costs = [level.width**2 * level.rate * level.quality for level in LEVELS]
    assert costs == sorted(costs, reverse=True)
    assert len(set(costs)) == len(costs)


def shares(rates: CameraRates, *factors: float, speed: float = 1.0) -> float:
    for factor in factors:
        rates.note(factor, speed)
    return rates.share


def test_cameras_yield_to_time_and_come_back() -> None:
    rates = CameraRates()
    assert shares(rates, 0.6) == 1.0, "one slow second is a hiccup"
    assert shares(rates, 0.99, 0.6, 0.99) == 1.0
    assert shares(rates, 0.6, 0.6) == CAMERA_SHARES[1]
    assert shares(rates, *[0.5] * 20) == CAMERA_SHARES[-1]
    assert shares(rates, *[1.0] * FIRST_PATIENCE) == CAMERA_SHARES[-2]
    assert shares(rates, *[1.0] * FIRST_PATIENCE * len(CAMERA_SHARES)) == 1.0


def test_faster_than_real_time_no_picture_is_dropped() -> None:
    assert shares(CameraRates(), *[3.0] * 20, speed=10.0) == 1.0
    assert shares(CameraRates(), *[3.0] * 20, speed=0.0) == 1.0


def test_slow_motion_is_judged_by_its_own_speed() -> None:
    assert shares(CameraRates(), *[0.5] * 20, speed=0.5) == 1.0
    assert shares(CameraRates(), *[0.3] * 3, speed=0.5) < 1.0


def shown(
    size: ViewSize, hz: float, seconds: float, *, begin_s: float = 0.0, wanted_hz: float = 30.0
) -> float:
    """Sends pictures at a rate, of a world of 60 Hz; returns the share of the width afterwards."""
    for i in range(round(seconds * hz)):
        now_s = begin_s + i / hz
        size.sent(now_s, 1 / wanted_hz, round(now_s * 60))
    return size.share


def test_a_view_gets_smaller_while_it_is_late_and_larger_after() -> None:
    size = ViewSize()
    assert shown(size, 29, 3) == 1.0
    assert shown(size, 12, 4, begin_s=3) < 0.6
    assert shown(size, 30, 60, begin_s=7) == 1.0


def test_a_view_of_a_world_that_pauses_or_is_slow_is_not_late() -> None:
    size = ViewSize()
    for i in range(20):  # a paused world that a user changes each second
        size.sent(float(i), 1 / 30, i)
    assert size.share == 1.0
    for i in range(100):  # a tenth of real time
        size.sent(20 + i / 6, 1 / 30, 20 + i)
    assert size.share == 1.0
    assert shown(ViewSize(), 2, 10, wanted_hz=2) == 1.0
