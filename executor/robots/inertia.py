"""Masses and inertia tensors. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from executor.world.geometry.transforms import compose, rotation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.world.geometry.transforms import Pose


@dataclass(frozen=True)
class Inertial:
    """The inertia of a rigid body.

    Args:
        mass: the mass in kg.
        pose: the pose of the frame of `tensor` in the link's frame; its origin is the centre of mass.
        tensor: the 3×3 inertia tensor in kg m².
    """

    mass: float
    pose: Pose
    tensor: NDArray[np.float64]

    def seen_from(self, pose: Pose) -> Inertial:
        """Returns the inertia in the frame in which the link has this pose."""
        return Inertial(self.mass, compose(pose, self.pose), self.tensor)

    def joined(self, other: Inertial) -> Inertial:
        """Returns the inertia of both bodies joined into one, with the axes of the link's frame.

        By the parallel axis theorem each body adds m (|d|² E - d dᵀ) to its tensor about the common centre.
        """
        mass = self.mass + other.mass
        if mass <= 0:
            return self
        centers = [np.array(part.pose[:3]) for part in (self, other)]
        center = (self.mass * centers[0] + other.mass * centers[1]) / mass
        tensor = np.zeros((3, 3))
        for part, own in zip((self, other), centers, strict=True):
            turned, shift = rotation(part.pose[3:]), own - center
            tensor += turned @ part.tensor @ turned.T
            tensor += part.mass * (shift @ shift * np.eye(3) - np.outer(shift, shift))
        x, y, z = center.tolist()
        return Inertial(mass, (x, y, z, 0.0, 0.0, 0.0, 1.0), tensor)
