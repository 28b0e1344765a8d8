"""Makes the bodies of a universe's models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from executor.messages import Shape
from executor.world.transforms import IDENTITY, Pose, from_xyz_rpy

if TYPE_CHECKING:
    from executor.universes.model import Model
    from executor.world.engine import Bullet

FINITE_PLANE_THICKNESS = 0.02


@dataclass(frozen=True)
class Body:
    """A body of the physics server that is neither robot nor actor."""

    uid: int
    is_dynamic: bool


def rgba(color: str) -> list[float]:
    """Returns #rrggbb or #rrggbbaa as numbers from 0 to 1."""
    digits = color[1:]
    channels = [int(digits[i : i + 2], 16) / 255 for i in range(0, len(digits), 2)]
    return channels if len(channels) == 4 else [*channels, 1.0]


def make_ground(bullet: Bullet, friction: float) -> int:
    """Makes the endless floor and returns its body."""
    ground: int = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_PLANE))
    bullet.changeDynamics(ground, -1, lateralFriction=friction, restitution=0.0)
    return ground


def make_body(bullet: Bullet, model: Model) -> Body:
    """Makes the body of a primitive model."""
    pose = from_xyz_rpy(model.pose)
    uid: int = bullet.createMultiBody(
        model.mass,
        _collision_shape(bullet, model) if model.solid else -1,
        basePosition=pose[:3],
        baseOrientation=pose[3:],
        useMaximalCoordinates=model.mass == 0,  # a third of the cost of a step where much stands about
    )
    bullet.changeDynamics(
        uid, -1, lateralFriction=model.friction, rollingFriction=0.001, spinningFriction=0.001,
        restitution=model.restitution,
    )  # fmt: skip
    return Body(uid, is_dynamic=model.mass > 0)


def scene_shape(model: Model) -> Shape:
    """Returns what one sees of a primitive model."""
    return Shape(shape=model.shape, size=list(model.size), pose=list(IDENTITY), color=rgba(model.color))


def capsule(bullet: Bullet, radius: float, length: float, at: Pose) -> int:
    """Makes a body without mass that somebody will carry about, and returns it."""
    shape = bullet.createCollisionShape(
        bullet.GEOM_CAPSULE, radius=radius, height=length, collisionFramePosition=at[:3]
    )
    uid: int = bullet.createMultiBody(0, shape)
    return uid


def _collision_shape(bullet: Bullet, model: Model) -> int:
    size = model.size
    if model.shape == "box":
        half = [length / 2 for length in size]
        shape: int = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=half)
    elif model.shape == "cylinder":
        shape = bullet.createCollisionShape(bullet.GEOM_CYLINDER, radius=size[0], height=size[1])
    elif model.shape == "sphere":
        shape = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=size[0])
    else:
        half = [size[0] / 2, size[1] / 2, FINITE_PLANE_THICKNESS / 2]
        below = [0, 0, -FINITE_PLANE_THICKNESS / 2]
        shape = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=half, collisionFramePosition=below)
    return shape
