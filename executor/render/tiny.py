"""The fallback renderer: PyBullet's TinyRenderer. It needs no OpenGL, and is slow."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from executor.render import geometry
from executor.render.interface import GROUND, NOTHING
from executor.render.layers import mean_color
from executor.world.engine import Bullet

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.messages import Scene, SceneObject, Shape
    from executor.render.interface import Viewpoint

GROUND_SIZE_M: Final = 80.0
AWAY: Final = (0.0, 0.0, -1000.0)


class TinyRenderer:
    """Draws with a separate physics server that holds visual shapes and simulates nothing."""

    name = "TinyRenderer"

    def __init__(self) -> None:
        self._bullet = Bullet()
        self.has_shadows = False  # shadows would double the time of this renderer, and have hard edges
        self._bodies: list[list[int]] = []
        self._ceilings: set[int] = set()
        self._ground = 0
        self._sun = [-0.3, -0.4, 0.8]

    def load(self, scene: Scene) -> None:
        """Replaces the scene."""
        self._bullet.resetSimulation()
        self._ceilings = set()
        self._meshes = scene.meshes
        self._paints = {name: mean_color(texture) for name, texture in scene.textures.items()}
        self._bodies = [self._body(scene_object) for scene_object in scene.objects]
        half = [GROUND_SIZE_M / 2, GROUND_SIZE_M / 2, 0.01]
        ground = self._bullet.createVisualShape(
            self._bullet.GEOM_BOX,
            halfExtents=half,
            rgbaColor=self._tinted(scene.ground_color, scene.ground_texture),
        )
        self._ground = self._bullet.createMultiBody(0, -1, ground, basePosition=[0, 0, -0.01])
        self._sun = [-value for value in scene.lights[0].direction]

    def draw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int, *, smooth: bool = True
    ) -> NDArray[np.uint8]:
        """Returns the picture as height × width × 3 bytes of RGB, the top row first."""
        del smooth  # TinyRenderer has no antialiasing
        picture = self._shoot(poses, view, width, height)[2]
        return np.ascontiguousarray(np.reshape(picture, (height, width, 4))[:, :, :3].astype(np.uint8))

    def redraw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.uint8]:
        """Returns the same as `draw`: this renderer cannot draw only the changes."""
        return self.draw(poses, view, width, height)

    def depth(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.float32]:
        """Returns the depth in m along the optical axis; +inf for the background."""
        shot = self._shoot(poses, view, width, height)
        buffer = np.reshape(shot[3], (height, width)).astype(np.float64)
        near, far = view.near, view.far
        metres: NDArray[np.float32] = (far * near / (far - (far - near) * buffer)).astype(np.float32)
        metres[np.reshape(shot[4], (height, width)) < 0] = np.inf
        return metres

    def segmentation(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.int32]:
        """Returns for each pixel the row of the object in the scene, `GROUND` or `NOTHING`."""
        seen = np.reshape(self._shoot(poses, view, width, height)[4], (height, width))
        # The table has one entry more than bodies, so that -1 (the sky) indexes the last entry.
        rows = np.full(self._ground + 2, NOTHING, np.int32)
        for row, uids in enumerate(self._bodies):
            rows[uids] = row
        rows[self._ground] = GROUND
        found: NDArray[np.int32] = rows[seen]
        return found

    def close(self) -> None:
        """Ends the physics server. May be called twice."""
        self._bullet.close()

    def _shoot(self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int) -> Any:
        for uids, pose in zip(self._bodies, poses.tolist(), strict=True):
            for uid in uids:
                place = AWAY if view.roofless and uid in self._ceilings else pose[:3]
                self._bullet.resetBasePositionAndOrientation(uid, place, pose[3:])
        return self._bullet.getCameraImage(
            width,
            height,
            viewMatrix=view.view_matrix().T.ravel().tolist(),
            projectionMatrix=view.projection_matrix(width, height).T.ravel().tolist(),
            lightDirection=self._sun,
            shadow=int(self.has_shadows),
            renderer=self._bullet.ER_TINY_RENDERER,
        )

    def _body(self, scene_object: SceneObject) -> list[int]:
        """Creates one body for each shape, since TinyRenderer gives all shapes of a body the same colour."""
        uids = [
            self._bullet.createMultiBody(0, -1, self._visual(shape), basePosition=scene_object.pose[:3])
            for shape in scene_object.shapes
        ]
        self._ceilings |= {uid for uid, shape in zip(uids, scene_object.shapes, strict=True) if shape.ceiling}
        return uids

    def _tinted(self, color: list[float], texture: str) -> list[float]:
        """Returns a colour tinted with the mean colour of a texture; this renderer draws no textures."""
        paint = self._paints.get(texture, (1.0, 1.0, 1.0))
        return [*(part * tint for part, tint in zip(color, paint, strict=False)), color[3]]

    def _visual(self, shape: Shape) -> int:
        bullet, size = self._bullet, shape.size
        common = {
            "rgbaColor": self._tinted(shape.color, shape.texture),
            "visualFramePosition": shape.pose[:3],
            "visualFrameOrientation": shape.pose[3:],
        }
        visual: int
        match shape.shape:
            case "box":
                visual = bullet.createVisualShape(
                    bullet.GEOM_BOX, halfExtents=[length / 2 for length in size], **common
                )
            case "plane":
                half = [size[0] / 2, size[1] / 2, 0.001]
                visual = bullet.createVisualShape(bullet.GEOM_BOX, halfExtents=half, **common)
            case "sphere":
                visual = self._triangles(geometry.capsule(1.0, 0.0), [size[0]] * 3, common)
            case "cylinder":
                visual = self._triangles(geometry.cylinder(), [size[0], size[0], size[1]], common)
            case "capsule":
                visual = self._triangles(geometry.capsule(size[0], size[1]), [1.0] * 3, common)
            case _:
                mesh = self._meshes[shape.mesh]
                vertices = geometry.from_mesh(mesh.positions, mesh.normals, mesh.indices)
                visual = self._triangles(vertices, size, common)
        return visual

    def _triangles(self, vertices: NDArray[np.float32], scale: list[float], common: dict[str, Any]) -> int:
        """Creates a shape from given triangles, since TinyRenderer's own round shapes are coarse."""
        points, order = geometry.indexed(vertices)
        visual: int = self._bullet.createVisualShape(
            self._bullet.GEOM_MESH,
            vertices=points[:, :3].tolist(),
            normals=points[:, 3:].tolist(),
            indices=order.tolist(),
            meshScale=scale,
            **common,
        )
        return visual
