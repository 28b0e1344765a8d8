"""The scene objects of a world, and functions that return the current poses of objects that move."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from executor.messages import SceneObject, Shape

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from executor.world.geometry.transforms import Pose

Kind = Literal["static", "dynamic", "robot", "actor"]


class SceneObjects:
    """Scene objects in the order of their ids; an object's id is its row in `poses`."""

    def __init__(self) -> None:
        self.objects: list[SceneObject] = []
        self._movers: list[Callable[[], Sequence[tuple[int, Pose]]]] = []
        self._poses = np.zeros((0, 7), np.float32)

    def add(self, body: str, link: str, kind: Kind, shapes: list[Shape], pose: Pose) -> int:
        """Adds an object and returns its id."""
        object_id = len(self.objects)
        self.objects.append(SceneObject(object_id, body, link, kind, shapes, list(pose)))
        return object_id

    def add_mover(self, where: Callable[[], Sequence[tuple[int, Pose]]]) -> None:
        """Adds a function that returns the current poses of some objects."""
        self._movers.append(where)

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
        if len(self._poses) != len(self.objects):
            self._poses = np.array([o.pose for o in self.objects], np.float32).reshape(-1, 7)
        poses = self._poses.copy()
        for where in self._movers:
            for object_id, pose in where():
                poses[object_id] = pose
        self._poses = poses
        return poses
