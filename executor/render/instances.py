"""Sorts a scene's shapes into groups of one mesh each, and keeps their matrices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.render import geometry

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.messages import Scene, Shape

GAMMA: Final = 2.0  # as in the shaders


@dataclass(frozen=True)
class Group:
    """Shapes that are drawn with one mesh: rows `first` to `first + count` of the instances."""

    vertices: NDArray[np.float32]
    first: int
    count: int


class Instances:
    """All shapes of a scene, one row each.

    A row is a 4×4 matrix (column after column), a linear colour, the object's row, and three unused values.
    """

    def __init__(self, scene: Scene) -> None:
        by_mesh: dict[tuple[object, ...], list[tuple[int, Shape]]] = {}
        for row, scene_object in enumerate(scene.objects):
            for shape in scene_object.shapes:
                by_mesh.setdefault(_mesh_key(shape), []).append((row, shape))
        self.groups: list[Group] = []
        members: list[tuple[int, Shape]] = []
        for key, group in by_mesh.items():
            self.groups.append(Group(_vertices(key, scene), len(members), len(group)))
            members += group
        self._object_rows = np.array([row for row, _ in members], np.intp)
        self._local = np.array([_local_matrix(shape) for _, shape in members], np.float32).reshape(-1, 4, 4)
        self._rows = np.zeros((len(members), 24), np.float32)
        self._rows[:, 20] = self._object_rows
        for i, (_, shape) in enumerate(members):
            self._rows[i, 16:19] = np.array(shape.color[:3]) ** GAMMA
            self._rows[i, 19] = shape.color[3]

    def __len__(self) -> int:
        return len(self._rows)

    def update(self, poses: NDArray[np.float32]) -> NDArray[np.float32]:
        """Returns the rows for poses of the scene's objects."""
        world = matrices(poses)[self._object_rows] @ self._local
        # Column after column, as OpenGL wants its matrices.
        self._rows[:, :16] = world.transpose(0, 2, 1).reshape(-1, 16)
        return self._rows


def matrices(poses: NDArray[np.float32]) -> NDArray[np.float32]:
    """Returns the 4×4 matrices of rows [x, y, z, qx, qy, qz, qw]."""
    x, y, z, w = poses[:, 3], poses[:, 4], poses[:, 5], poses[:, 6]
    result = np.zeros((len(poses), 4, 4), np.float32)
    result[:, 0, 0] = 1 - 2 * (y * y + z * z)
    result[:, 0, 1] = 2 * (x * y - z * w)
    result[:, 0, 2] = 2 * (x * z + y * w)
    result[:, 1, 0] = 2 * (x * y + z * w)
    result[:, 1, 1] = 1 - 2 * (x * x + z * z)
    result[:, 1, 2] = 2 * (y * z - x * w)
    result[:, 2, 0] = 2 * (x * z - y * w)
    result[:, 2, 1] = 2 * (y * z + x * w)
    result[:, 2, 2] = 1 - 2 * (x * x + y * y)
    result[:, :3, 3] = poses[:, :3]
    result[:, 3, 3] = 1.0
    return result


def _mesh_key(shape: Shape) -> tuple[object, ...]:
    # A capsule cannot be stretched without spoiling its ends, so each size is a mesh of its own.
    if shape.shape == "capsule":
        return ("capsule", *shape.size)
    return (shape.shape, shape.mesh) if shape.shape == "mesh" else (shape.shape,)


def _vertices(key: tuple[object, ...], scene: Scene) -> NDArray[np.float32]:
    match key:
        case ("box",):
            return geometry.box()
        case ("cylinder",):
            return geometry.cylinder()
        case ("sphere",):
            return geometry.capsule(1.0, 0.0)
        case ("plane",):
            return geometry.square()
        case ("capsule", float(radius), float(length)):
            return geometry.capsule(radius, length)
        case ("mesh", str(name)):
            mesh = scene.meshes[name]
            return geometry.from_mesh(mesh.positions, mesh.normals, mesh.indices)
    raise ValueError(f"there is no shape {key}")


def _local_matrix(shape: Shape) -> NDArray[np.float32]:
    matrix = matrices(np.array([shape.pose], np.float32))[0]
    scale = np.array([*_scale(shape), 1.0], np.float32)
    scaled: NDArray[np.float32] = matrix * scale
    return scaled


def _scale(shape: Shape) -> tuple[float, float, float]:
    size = shape.size
    match shape.shape:
        case "cylinder":
            return size[0], size[0], size[1]
        case "sphere":
            return size[0], size[0], size[0]
        case "plane":
            return size[0], size[1], 1.0
        case "capsule":
            return 1.0, 1.0, 1.0
        case _:
            return size[0], size[1], size[2]
