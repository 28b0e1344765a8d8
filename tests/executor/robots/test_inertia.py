"""Masses and inertia of bodies that are joined."""

from __future__ import annotations

import numpy as np
import pytest

from executor.robots.inertia import Inertial


def point(mass: float, x: float) -> Inertial:
    return Inertial(mass, (x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), np.zeros((3, 3)))


def test_two_points_are_a_dumb_bell() -> None:
    both = point(1.0, -1.0).joined(point(1.0, 1.0))
    assert (both.mass, both.pose[0]) == (2.0, 0.0)
    assert np.diag(both.tensor) == pytest.approx([0.0, 2.0, 2.0])
    heavy = point(3.0, 0.0).joined(point(1.0, 4.0))
    assert heavy.pose[0] == pytest.approx(1.0)


def test_it_is_seen_from_another_pose() -> None:
    assert point(1.0, 1.0).seen_from((0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 1.0)).pose[:3] == pytest.approx((1, 5, 0))
