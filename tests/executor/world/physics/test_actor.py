"""A person who walks."""

from __future__ import annotations

import pytest

from executor.universes import parse_universe
from executor.world.engine import Bullet
from executor.world.physics.actor import BulletActor

TEXT = """format: bt-studio/universe
version: 1
name: test
actors: [{id: ada, path: [[0, 0], [4, 0]], speed: 1.0}]
"""


def test_an_actor_follows_its_path_with_bodies_that_can_be_bumped_into() -> None:
    bullet = Bullet()
    [described] = parse_universe(TEXT).actors
    actor = BulletActor(bullet, described)
    assert actor.position == pytest.approx((0, 0))
    for _ in range(20):
        actor.advance(0.1)
    assert actor.position[0] == pytest.approx(2.0, abs=0.2)
    assert len(actor.uids) == bullet.getNumBodies() > 0
    bullet.close()
