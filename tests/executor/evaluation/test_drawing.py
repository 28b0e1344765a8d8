"""Drawn values depend on seed and address alone."""

import hashlib

import numpy as np

from executor.evaluation.document import Draw
from executor.evaluation.drawing import bounds_of, draw_pose, draw_range, draw_value, generator_of


def test_the_generator_is_the_documented_one():
    digest = hashlib.sha256(b"7\nmodels.crate.mass\n3\n").digest()
    wanted = np.random.Generator(np.random.PCG64(int.from_bytes(digest, "big"))).uniform(1, 2, 5)
    assert generator_of(7, "models.crate.mass", 3).uniform(1, 2, 5).tolist() == wanted.tolist()


def test_each_kind_of_draw():
    seeds = range(400)
    uniform = [float(draw_value(Draw(uniform=(1, 3)), seed, "a")) for seed in seeds]
    assert all(1 <= value <= 3 for value in uniform)
    assert 1.9 < np.mean(uniform) < 2.1
    clipped = [draw_value(Draw(normal=(1, 1), clip=(0.5, 1.5)), seed, "a") for seed in seeds]
    assert (min(clipped), max(clipped)) == (0.5, 1.5)
    chosen = [draw_value(Draw(choice=(0.2, "fast", True)), seed, "a") for seed in seeds]
    assert set(chosen) == {0.2, "fast", True}
    whole = [draw_value(Draw(uniform=(1, 3)), seed, "a", whole=True) for seed in seeds]
    assert set(whole) == {1, 2, 3}
    assert all(isinstance(value, int) for value in whole)


def test_a_pose_keeps_height_and_tilt():
    corners = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    before = (9, 9, 0.3, 0.1, 0.2, 0.5)
    x, y, *rest = draw_pose(Draw(area="a"), corners, before, 1, "robot.pose", 0)
    assert 0 <= x <= 1
    assert 0 <= y <= 1
    assert rest == [0.3, 0.1, 0.2, 0.5]
    assert draw_pose(Draw(area="a", yaw=(1, 2)), corners, before, 1, "robot.pose", 0)[5] != 0.5
    assert draw_pose(Draw(area="a"), corners, before, 1, "robot.pose", 1)[:2] != (x, y)


def test_bounds_and_ranges():
    assert bounds_of(Draw(uniform=(1, 2))) == [1, 2]
    assert bounds_of(Draw(normal=(1, 2), clip=(0, 3))) == [0, 3]
    assert bounds_of(Draw(choice=("a", 2))) == ["a", 2]
    assert draw_range(4.0, 1, "x") == 4.0
    assert 5 <= draw_range((5.0, 6.0), 1, "x") <= 6
