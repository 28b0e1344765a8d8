"""Interface of renderers, and their cameras."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from executor.messages import Scene


NOTHING: Final = -1
"""Value in a segmentation: neither an object nor the ground."""
GROUND: Final = -2
"""Value in a segmentation: the ground."""


class RenderError(Exception):
    """This renderer cannot work on this machine."""


@dataclass(frozen=True)
class Viewpoint:
    """A pinhole camera. Vectors are of unit length in the world frame, lengths in m.

    Args:
        fov: horizontal field of view in rad.
        roofless: whether ceilings are left out, as in views from outside.
    """

    eye: tuple[float, float, float]
    ahead: tuple[float, float, float]
    up: tuple[float, float, float]
    fov: float
    near: float = 0.05
    far: float = 60.0
    roofless: bool = False

    @classmethod
    def of_pose(cls, pose: Sequence[float], fov: float, near: float, far: float) -> Viewpoint:
        """Returns the camera that looks along x of a pose [x, y, z, qx, qy, qz, qw], with z up."""
        x, y, z, w = (float(value) for value in pose[3:7])
        ahead = (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w))
        up = (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))
        return cls((float(pose[0]), float(pose[1]), float(pose[2])), ahead, up, fov, near, far)

    def view_matrix(self) -> NDArray[np.float64]:
        """Returns the transform from the world to eye coordinates (x right, y up, z back)."""
        ahead, up = np.array(self.ahead), np.array(self.up)
        right = np.cross(ahead, up)
        rotation = np.array([right, up, -ahead])
        matrix = np.eye(4)
        matrix[:3, :3] = rotation
        matrix[:3, 3] = -rotation @ np.array(self.eye)
        return matrix

    def projection_matrix(self, width: int, height: int) -> NDArray[np.float64]:
        """Returns the transform from eye to clip coordinates."""
        focal = 1.0 / math.tan(self.fov / 2)
        near, far = self.near, self.far
        matrix = np.zeros((4, 4))
        matrix[0, 0] = focal
        matrix[1, 1] = focal * width / height
        matrix[2, 2] = -(far + near) / (far - near)
        matrix[2, 3] = -2 * far * near / (far - near)
        matrix[3, 2] = -1.0
        return matrix


def look_at(eye: Sequence[float], target: Sequence[float], fov: float = 1.0) -> Viewpoint:
    """Returns the view from one point to another, with the horizon level and without ceilings."""
    ahead = np.array(target, float) - np.array(eye, float)
    length = float(np.linalg.norm(ahead))
    ahead = ahead / length if length > 1e-6 else np.array([1.0, 0.0, 0.0])
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    if np.linalg.norm(right) < 1e-6:
        right = np.array([0.0, -1.0, 0.0])  # straight down: x is up in the picture
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    position = (float(eye[0]), float(eye[1]), float(eye[2]))
    ends = tuple(ahead.tolist()), tuple(up.tolist())
    return Viewpoint(position, *ends, fov, near=0.05, far=120.0, roofless=True)


class Renderer(Protocol):
    """Draws a scene. Not thread-safe."""

    name: str

    def load(self, scene: Scene) -> None:
        """Replaces the scene."""

    def draw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int, *, smooth: bool = True
    ) -> NDArray[np.uint8]:
        """Returns the picture as height × width × 3 bytes of RGB, the top row first.

        Args:
            poses: one row [x, y, z, qx, qy, qz, qw] for each object of the scene.
            view: the camera.
            width: the width of the picture in pixels.
            height: the height of the picture in pixels.
            smooth: whether to use antialiasing, if supported; it doubles the cost.
        """

    def redraw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.uint8]:
        """Returns the same as `draw`, but may draw only the changes. Use it for views that are drawn often.

        If nothing has changed, it may return the same array as before. Do not write into it.
        """

    def depth(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.float32]:
        """Returns the depth in m along the optical axis (not the ray), the top row first.

        It is +inf beyond `view.far`, as in REP-117. Surfaces nearer than `view.near` are clipped.
        """

    def segmentation(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.int32]:
        """Returns each pixel's object (its row in the scene), `GROUND` or `NOTHING`, the top row first."""

    def close(self) -> None:
        """Frees all resources. May be called twice."""
