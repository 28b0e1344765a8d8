"""Bodies in the physics server."""

from __future__ import annotations

import pytest

from executor.universes import parse_universe
from executor.world.engine import Bullet
from executor.world.physics.bodies import make_body, make_ground, rgba, scene_shapes

TEXT = """format: bt-studio/universe
version: 1
name: test
models:
- {id: box, shape: box, size: [1, 2, 3], pose: [0, 0, 1.5, 0, 0, 0], color: "#ff0000"}
- {id: ball, shape: sphere, size: [0.5], pose: [3, 0, 1, 0, 0, 0], mass: 2}
"""


def test_a_model_is_a_body_and_a_shape() -> None:
    bullet = Bullet()
    make_ground(bullet, 0.8)
    box, ball = parse_universe(TEXT).models
    assert rgba("#ff0000")[:3] == pytest.approx([1, 0, 0])
    assert [shape.shape for shape in scene_shapes(box)] == ["box"]
    assert make_body(bullet, box) != make_body(bullet, ball)
    assert bullet.getNumBodies() == 3
    bullet.close()
