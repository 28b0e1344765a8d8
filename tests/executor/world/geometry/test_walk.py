import math

import pytest

from executor.world.geometry.walk import AHEAD_M, ROOM_M, Gait, Path, Walker

SQUARE = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))


def test_a_loop_returns_to_its_start() -> None:
    path = Path(SQUARE, loop=True)
    assert path.length_m == 8.0
    assert path.at(3.0) == pytest.approx((2.0, 1.0, math.pi / 2))
    assert path.at(9.0) == pytest.approx(path.at(1.0))


def test_without_a_loop_one_walks_there_and_back() -> None:
    path = Path(((0.0, 0.0), (3.0, 0.0)), loop=False)
    assert path.length_m == 6.0
    assert path.at(4.0)[:2] == pytest.approx((2.0, 0.0))
    assert abs(path.at(4.0)[2]) == pytest.approx(math.pi)


def test_a_single_point_is_stood_on() -> None:
    walker = Walker(Path(((1.0, 2.0),), loop=True), 0.5)
    gait = walker.advance(10.0)
    assert (gait.x, gait.y, gait.swing) == (1.0, 2.0, 0.0)


def test_speed_is_kept_and_turns_are_smooth() -> None:
    walker = Walker(Path(SQUARE, loop=True), 0.5)
    before = walker.gait
    for _ in range(600):
        gait = walker.advance(1 / 60)
        step = math.dist((before.x, before.y), (gait.x, gait.y))
        assert step <= 0.5 / 60 + 1e-9
        turn = math.remainder(gait.yaw - before.yaw, 2 * math.pi)
        assert abs(turn) <= 3.0 / 60 + 1e-9
        before = gait
    assert before.distance_m == pytest.approx(5.0)


def test_legs_swing_while_walking() -> None:
    walker = Walker(Path(SQUARE, loop=True), 0.5)
    gaits: list[Gait] = [walker.advance(1 / 60) for _ in range(300)]
    swings = [gait.swing for gait in gaits]
    assert max(swings) > 0.2
    assert min(swings) < -0.2


def test_one_waits_before_what_is_in_the_way_but_walks_away_from_what_is_behind() -> None:
    path = Path(((0.0, 0.0), (4.0, 0.0)), loop=False)
    walker = Walker(path, 0.5)
    ahead, behind = (2.0, 0.0, 0.2), (-0.3, 0.0, 0.2)
    for _ in range(600):
        walker.advance(1 / 60, [ahead, behind])
    assert walker.gait.x == pytest.approx(2.0 - 0.2 - ROOM_M - AHEAD_M[-1], abs=0.02)
    walker.advance(1 / 60, [behind])
    assert walker.gait.x > 1.0
