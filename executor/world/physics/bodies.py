"""Creates the bodies of a universe's models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec.structs import replace

from executor.messages import Shape
from executor.world.geometry.mesh import ColoredMesh, MeshError, load_colored
from executor.world.geometry.transforms import IDENTITY, Pose, from_xyz_rpy
from executor.world.interface import WorldError
from executor.world.physics.paint import texture_key

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from executor.messages import Mesh
    from executor.universes.model import Model
    from executor.world.engine import Bullet
    from executor.world.geometry.mesh_colors import Rgba

FINITE_PLANE_THICKNESS = 0.02


@dataclass(frozen=True)
class Body:
    """A body of the physics server that is neither a robot nor an actor."""

    uid: int
    is_dynamic: bool


def rgba(color: str) -> list[float]:
    """Returns #rrggbb or #rrggbbaa as numbers from 0 to 1."""
    digits = color[1:]
    channels = [int(digits[i : i + 2], 16) / 255 for i in range(0, len(digits), 2)]
    return channels if len(channels) == 4 else [*channels, 1.0]


def make_ground(bullet: Bullet, friction: float) -> int:
    """Creates the infinite floor and returns its body."""
    ground: int = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_PLANE))
    # Bullet multiplies the restitution of both sides: with 1, that of the falling body counts.
    bullet.changeDynamics(ground, -1, lateralFriction=friction, restitution=1.0)
    return ground


def model_mesh(model: Model, assets: Path | None) -> ColoredMesh:
    """Reads the mesh of a model from the project's files, with its colours.

    Raises:
        WorldError: the mesh is missing, or cannot be used.
    """
    try:
        if assets is None:
            raise MeshError("there are no project files to take it from")
        path = assets / model.file
        if not path.resolve().is_relative_to(assets.resolve()):
            raise MeshError("it lies outside of the project")
        root = assets.resolve()
        return load_colored(path, lambda found: found.resolve().is_relative_to(root))
    except MeshError as error:
        raise WorldError(f"the mesh {model.file!r} of {model.id!r} cannot be used: {error}") from error


def make_body(bullet: Bullet, model: Model, mesh: Mesh | None = None) -> Body:
    """Creates the body of a model."""
    pose = from_xyz_rpy(model.pose)
    uid: int = bullet.createMultiBody(
        model.mass,
        _collision_shape(bullet, model, mesh) if model.solid else -1,
        basePosition=pose[:3],
        baseOrientation=pose[3:],
        useMaximalCoordinates=model.mass == 0,  # shortens steps by a third in worlds with many static bodies
    )
    bullet.changeDynamics(
        uid, -1, lateralFriction=model.friction, rollingFriction=0.001, spinningFriction=0.001,
        restitution=model.restitution, linearDamping=0.0, angularDamping=0.0,
    )  # fmt: skip
    if model.mass == 0:
        # Sleeping static bodies are not updated in each step, but still stop other bodies.
        bullet.changeDynamics(uid, -1, activationState=bullet.ACTIVATION_STATE_SLEEP)
    return Body(uid, is_dynamic=model.mass > 0)


def scene_shapes(model: Model, parts: Sequence[tuple[Rgba | None, str]] = ()) -> list[Shape]:
    """Returns the visual shapes of a model of one shape.

    Args:
        model: the model.
        parts: the meshes of the single colours of its file, which are shown if the model has none of its own.
    """
    shape = Shape(
        shape=model.shape,  # type: ignore[arg-type]  # assemblies are not asked
        size=list(model.size or (1.0, 1.0, 1.0)),
        pose=list(IDENTITY),
        color=rgba(model.color),
        mesh=model.file,
        texture=texture_key(model),
    )
    if not parts or shape.texture or model.color != type(model).model_fields["color"].default:
        return [shape]
    return [replace(shape, mesh=mesh, color=list(color or shape.color)) for color, mesh in parts]


def capsule(bullet: Bullet, radius: float, length: float, at: Pose) -> int:
    """Creates a body without mass, to be moved from outside."""
    shape = bullet.createCollisionShape(
        bullet.GEOM_CAPSULE, radius=radius, height=length, collisionFramePosition=at[:3]
    )
    uid: int = bullet.createMultiBody(0, shape)
    return uid


def _collision_shape(bullet: Bullet, model: Model, mesh: Mesh | None) -> int:
    size = model.size
    if mesh is not None:
        return _mesh_shape(bullet, model, mesh)
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


def _mesh_shape(bullet: Bullet, model: Model, mesh: Mesh) -> int:
    """Creates the collision shape of a mesh: its triangles if it never moves, otherwise its convex hull."""
    points = np.frombuffer(mesh.positions, "<f4").reshape(-1, 3).tolist()
    options: dict[str, Any] = {"meshScale": list(model.size or (1.0, 1.0, 1.0))}
    if model.mass == 0:
        options |= {"flags": bullet.GEOM_FORCE_CONCAVE_TRIMESH}
        options |= {"indices": np.frombuffer(mesh.indices, "<u4").tolist()}
    shape: int = bullet.createCollisionShape(bullet.GEOM_MESH, vertices=points, **options)
    if shape < 0:
        raise WorldError(f"the mesh of {model.id!r} is too large to be solid; make it smaller")
    return shape
