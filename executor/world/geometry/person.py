"""The rigid parts of a person, with hinges, in the frame of a standing person who faces along x."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor.messages import Shape
from executor.world.geometry.transforms import Pose, compose, from_xyz_rpy

if TYPE_CHECKING:
    from executor.world.geometry.walk import Gait

SKIN: Final = [0.87, 0.68, 0.55, 1.0]
HAIR: Final = [0.20, 0.13, 0.09, 1.0]
SHOE: Final = [0.13, 0.12, 0.14, 1.0]

Rgba = list[float]


@dataclass(frozen=True)
class Part:
    """A rigid part.

    `sign` is the direction of its swing in the gait; `capsule` holds its radius, its length and its z.
    """

    name: str
    hinge: tuple[float, float, float]
    sign: float
    shapes: tuple[Shape, ...]
    capsule: tuple[float, float, float] | None = None

    def pose(self, gait: Gait) -> Pose:
        """Returns the pose of the part in the world."""
        stand = from_xyz_rpy((gait.x, gait.y, 0, 0, 0, gait.yaw))
        return compose(stand, from_xyz_rpy((*self.hinge, 0, -self.sign * gait.swing, 0)))


def person_parts(color: Rgba) -> tuple[Part, ...]:
    """Returns the parts of a person 1.75 m tall in clothes of one colour."""
    trousers = [channel * 0.8 for channel in color[:3]] + [1.0]
    return (
        Part("body", (0, 0, 0), 0.0, _body(color, trousers), (0.2, 0.65, 1.2)),
        _leg("left_leg", 0.095, 1.0, trousers),
        _leg("right_leg", -0.095, -1.0, trousers),
        _arm("left_arm", 0.225, -1.0, color),
        _arm("right_arm", -0.225, 1.0, color),
    )


def _body(color: Rgba, trousers: Rgba) -> tuple[Shape, ...]:
    return (
        _shape("capsule", [0.15, 0.20], (0, 0.055, 1.20), color),
        _shape("capsule", [0.15, 0.20], (0, -0.055, 1.20), color),
        _shape("capsule", [0.055, 0.30], (0, 0, 1.38), color, roll=1.5708),
        _shape("capsule", [0.125, 0.10], (0, 0, 0.93), trousers, roll=1.5708),
        _shape("cylinder", [0.05, 0.12], (0, 0, 1.47), SKIN),
        _shape("capsule", [0.092, 0.05], (0.005, 0, 1.615), SKIN),
        _shape("capsule", [0.096, 0.03], (-0.018, 0, 1.645), HAIR),
        _shape("sphere", [0.018], (0.098, 0, 1.605), SKIN),
    )


def _leg(name: str, y: float, sign: float, color: Rgba) -> Part:
    shapes = (
        _shape("capsule", [0.078, 0.34], (0, 0, -0.21), color),
        _shape("capsule", [0.062, 0.34], (0, 0, -0.58), color),
        _shape("box", [0.24, 0.09, 0.07], (0.045, 0, -0.845), SHOE),
    )
    return Part(name, (0, y, 0.88), sign, shapes, (0.08, 0.66, -0.45))


def _arm(name: str, y: float, sign: float, color: Rgba) -> Part:
    shapes = (
        _shape("capsule", [0.052, 0.24], (0, 0, -0.13), color),
        _shape("capsule", [0.044, 0.22], (0.01, 0, -0.38), color),
        _shape("sphere", [0.048], (0.015, 0, -0.54), SKIN),
    )
    return Part(name, (0, y, 1.38), sign, shapes)


def _shape(
    kind: str, size: list[float], at: tuple[float, float, float], color: Rgba, *, roll: float = 0
) -> Shape:
    return Shape(shape=kind, size=size, pose=list(from_xyz_rpy((*at, roll, 0, 0))), color=color)  # type: ignore[arg-type]
