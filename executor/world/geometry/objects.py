"""The scene objects of a world, and functions that read where the objects are that move."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import numpy as np

from executor.messages import SceneObject, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from executor.world.geometry.transforms import Pose

Kind = Literal["static", "dynamic", "robot", "actor"]
Where = Callable[[], "Sequence[tuple[int, Pose]]"]
"""Computes the poses of some objects from what was read before."""


class SceneObjects:
    """Scene objects in the order of their ids; an object's id is its row in `poses`."""

    def __init__(self) -> None:
        self.objects: list[SceneObject] = []
        self._movers: list[Callable[[], Where]] = []
        self._poses = np.zeros((0, 7), np.float32)

    def add(self, body: str, link: str, kind: Kind, shapes: list[Shape], pose: Pose) -> int:
        """Adds an object and returns its id."""
        object_id = len(self.objects)
        self.objects.append(SceneObject(object_id, body, link, kind, shapes, list(pose)))
        return object_id

    def add_mover(self, read: Callable[[], Where]) -> None:
        """Adds a function that reads where some objects are now, and leaves the computing for later."""
        self._movers.append(read)

    def place(self, object_id: int, pose: Pose) -> None:
        """Stores the pose of an object that has no mover."""
        self.objects[object_id].pose = list(pose)
        if object_id < len(self._poses):
            self._poses = self._poses.copy()  # callers may keep the last array unchanged
            self._poses[object_id] = pose

    def tell(self, poses: NDArray[np.float32]) -> None:
        """Writes the poses into the objects, before the scene is sent."""
        for scene_object, pose in zip(self.objects, poses.tolist(), strict=True):
            scene_object.pose = pose

    def update(self) -> NDArray[np.float32]:
        """Returns the current poses of all objects in a new array."""
        self._poses = self.read()()
        return self._poses

    def read(self) -> Callable[[], NDArray[np.float32]]:
        """Returns a function that computes the poses of this moment at any later time, in a new array."""
        if len(self._poses) != len(self.objects):
            self._poses = np.array([o.pose for o in self.objects], np.float32).reshape(-1, 7)
        before = self._poses  # nobody writes into it
        found = [read() for read in self._movers]

        def computed() -> NDArray[np.float32]:
            poses = before.copy()
            for where in found:
                for object_id, pose in where():
                    poses[object_id] = pose
            return poses

        return computed
