"""Poses of bodies that are set."""

from __future__ import annotations

import pytest

from executor.world.engine import Bullet
from executor.world.physics.placement import put, put_at_rest


def test_a_body_is_put_and_may_be_stopped() -> None:
    bullet = Bullet()
    body = bullet.createMultiBody(1.0, bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=0.1))
    put(bullet, body, (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0))
    assert bullet.getBasePositionAndOrientation(body)[0] == pytest.approx((1, 2, 3))
    bullet.resetBaseVelocity(body, (1, 0, 0))
    put_at_rest(bullet, body, (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))
    assert bullet.getBaseVelocity(body)[0] == pytest.approx((0, 0, 0))
    bullet.close()
