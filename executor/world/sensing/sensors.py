"""Measurements of a world's sensors, each made at most once a step, for ROS and streams."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from executor.render.interface import Renderer, Viewpoint
from executor.render.jpeg import BEST_QUALITY, to_jpeg

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from numpy.typing import NDArray

    from executor.robots.config import Camera, Lidar
    from executor.world.interface import LidarReading, Robot, World

    Picture = NDArray[np.uint8]


class Sensors:
    """Makes measurements and pictures on demand. Call `changed` after each step.

    Args:
        renderer: creates the renderer; called for the first picture.
    """

    def __init__(self, world: World, renderer: Callable[[], Renderer]) -> None:
        self._world = world
        self._make_renderer = renderer
        self._renderer: Renderer | None = None
        self._kept: dict[Hashable, object] = {}
        self.version = 0

    @property
    def renderer_name(self) -> str:
        """The name of the renderer that is in use; "" before the first picture."""
        return self._renderer.name if self._renderer is not None else ""

    def changed(self) -> None:
        """Discards all measurements."""
        self.version += 1
        self._kept.clear()

    def load_scene(self) -> None:
        """Loads the world's scene again after a reset."""
        if self._renderer is not None:
            self._renderer.load(self._world.scene)
        self.changed()

    def scan(self, robot: Robot, lidar: Lidar) -> LidarReading:
        """Returns the current scan of a LIDAR."""
        key = ("scan", robot.id, lidar.name)
        if key not in self._kept:
            self._kept[key] = robot.scan(lidar)
        return self._kept[key]  # type: ignore[return-value]

    def picture(self, robot: Robot, camera: Camera, width: int | None = None) -> Picture:
        """Returns the current image of a camera, in its configured size, or scaled to `width`."""
        wide = min(width or camera.width, camera.width)
        high = max(1, round(camera.height * wide / camera.width))
        key = ("picture", robot.id, camera.name, wide)
        if key not in self._kept:
            view = Viewpoint.of_pose(robot.camera_pose(camera), camera.fov, camera.near, camera.far)
            self._kept[key] = self._draw(view, wide, high, smooth=True)
        return self._kept[key]  # type: ignore[return-value]

    def jpeg(
        self, robot: Robot, camera: Camera, width: int | None = None, quality: int = BEST_QUALITY
    ) -> bytes:
        """Returns the current image of a camera as JPEG; coded once for all that take it."""
        picture = self.picture(robot, camera, width)
        key = ("jpeg", robot.id, camera.name, picture.shape[1], quality)
        if key not in self._kept:
            self._kept[key] = to_jpeg(picture, quality)
        return self._kept[key]  # type: ignore[return-value]

    def depth(self, robot: Robot, camera: Camera) -> NDArray[np.float32]:
        """Returns the current depth image of a camera, in m along the optical axis.

        -inf is too near, +inf too far.
        """
        key = ("depth", robot.id, camera.name)
        if key not in self._kept:
            view = Viewpoint.of_pose(robot.camera_pose(camera), camera.fov, camera.near, camera.far)
            renderer = self._loaded()
            metres = renderer.depth(self._world.poses(), view, camera.width, camera.height)
            metres = np.where(metres > camera.depth_max, np.inf, metres)
            self._kept[key] = np.where(metres < camera.depth_min, -np.inf, metres).astype(np.float32)
        return self._kept[key]  # type: ignore[return-value]

    def view(self, viewpoint: Viewpoint, width: int, height: int) -> Picture:
        """Returns a view of the world; if nothing in the world changed, the same array as before."""
        return self._loaded().redraw(self._world.poses(), viewpoint, width, height)

    def close(self) -> None:
        """Frees the renderer."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def _draw(self, view: Viewpoint, width: int, height: int, *, smooth: bool) -> Picture:
        return self._loaded().draw(self._world.poses(), view, width, height, smooth=smooth)

    def _loaded(self) -> Renderer:
        if self._renderer is None:
            self._renderer = self._make_renderer()
            self._renderer.load(self._world.scene)
        return self._renderer
