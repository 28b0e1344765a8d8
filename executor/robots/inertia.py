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
        mass: in kg.
        pose: of the frame of `tensor`, whose origin is the centre of mass, in the link's frame.
        tensor: 3×3, in kg m².
    """

    mass: float
    pose: Pose
    tensor: NDArray[np.float64]

    def seen_from(self, pose: Pose) -> Inertial:
        """Returns the inertia of a link at this pose, in the frame of the pose."""
        return Inertial(self.mass, compose(pose, self.pose), self.tensor)

    def joined(self, other: Inertial) -> Inertial:
        """Returns the inertia of both as one body, with the axes of the link's frame.

        The parallel axis theorem: about the common centre each adds m (|d|² E - d dᵀ).
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
