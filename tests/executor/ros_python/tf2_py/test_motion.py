"""Rigid motions."""

import math

import pytest


def test_there_and_back_is_nowhere() -> None:
    from tf2_py.motion import Motion, between, compose, inverse, rotate

    half = math.sqrt(0.5)
    turned = Motion((1.0, 2.0, 3.0), (0.0, 0.0, half, half))
    nowhere = compose(turned, inverse(turned))
    assert nowhere.translation == pytest.approx((0, 0, 0))
    assert nowhere.rotation == pytest.approx((0, 0, 0, 1))
    assert rotate(turned.rotation, (1.0, 0.0, 0.0)) == pytest.approx((0, 1, 0))
    middle = between(Motion(), turned, 0.5)
    assert middle.translation == pytest.approx((0.5, 1, 1.5))
    assert 2 * math.asin(middle.rotation[2]) == pytest.approx(math.pi / 4)
