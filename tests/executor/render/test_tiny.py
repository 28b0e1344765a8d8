"""The renderer that needs no OpenGL."""

from __future__ import annotations

from executor.render import look_at
from executor.render.tiny import TinyRenderer
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld


def test_a_picture_has_the_size_that_is_asked_for() -> None:
    world = BulletWorld(load_builtin("walled_room"))
    renderer = TinyRenderer()
    renderer.load(world.scene)
    picture = renderer.draw(world.poses(), look_at((3, 3, 3), (0, 0, 0)), 64, 48)
    assert picture.shape == (48, 64, 3)
    assert picture.std() > 1
    renderer.close()
    renderer.close()
    world.close()
