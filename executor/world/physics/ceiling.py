"""Ceilings: only robots' cameras see them.

From outside only a roof would be visible, so views of the world leave ceilings out, and show walls with their
own height. A ceiling casts no shadow: the sun lights rooms as if it did not exist.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from executor.messages import Shape
from executor.world.geometry.transforms import IDENTITY, Pose, from_xyz_rpy
from executor.world.physics.bodies import rgba
from executor.world.physics.paint import texture_key

if TYPE_CHECKING:
    from executor.universes.model import Model, Universe

NAME: Final = "ceiling"
OVERLAP_M: Final = 0.01
"""Overlap of a wall's upper and lower parts, so that no crack is visible."""


def ceiling_of(universe: Universe) -> tuple[Shape, Pose] | None:
    """Returns the ceiling, a face that looks down.

    It covers the models that reach it, or all models if none does.
    """
    ceiling = universe.ceiling
    standing = [model for model in universe.models if model.mass == 0 and len(model.size) == 3]
    under = [model for model in standing if model.to_ceiling] or standing
    if ceiling is None or not under:
        return None
    (left, right), (low, high) = (_reach(under, axis) for axis in (0, 1))
    shape = Shape(
        shape="plane",
        size=[right - left, high - low],
        pose=list(IDENTITY),
        color=rgba(ceiling.color),
        texture=texture_key(ceiling),
        ceiling=True,
    )
    return shape, from_xyz_rpy(((left + right) / 2, (low + high) / 2, ceiling.height, math.pi, 0.0, 0.0))


def upper_part(model: Model, universe: Universe) -> list[Shape]:
    """Returns the part of a wall above its own height, if it reaches the ceiling."""
    if universe.ceiling is None or not model.to_ceiling:
        return []
    x, y, z = model.size
    top = z / 2
    missing = universe.ceiling.height - (model.pose[2] + top)
    if missing <= 0:
        return []
    length = missing + OVERLAP_M
    middle = (0.0, 0.0, top - OVERLAP_M + length / 2, *IDENTITY[3:])
    texture = texture_key(model)
    return [Shape("box", [x, y, length], list(middle), rgba(model.color), texture=texture, ceiling=True)]


def _reach(models: list[Model], axis: int) -> tuple[float, float]:
    """Returns the range of models along x (0) or y (1)."""
    ends = []
    for model in models:
        yaw, (x, y, _) = model.pose[5], model.size
        c, s = abs(math.cos(yaw)), abs(math.sin(yaw))
        half = ((c * x + s * y) / 2, (s * x + c * y) / 2)[axis]
        ends += [model.pose[axis] - half, model.pose[axis] + half]
    return min(ends), max(ends)
