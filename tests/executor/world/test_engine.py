"""Each physics server is separate."""

from __future__ import annotations

from executor.world.engine import Bullet


def test_two_servers_know_nothing_of_each_other() -> None:
    one, two = Bullet(), Bullet()
    shape = one.createCollisionShape(one.GEOM_SPHERE, radius=0.1)
    one.createMultiBody(1.0, shape)
    assert (one.getNumBodies(), two.getNumBodies()) == (1, 0)
    for bullet in (one, two, one):
        bullet.close()
