"""The shapes of a link: what is seen, what is touched, and whether both are the same."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor.robots.sdf_model import mass_of, shape_of, turned
from executor.sdf.values import numbers, text_of
from executor.world.geometry.transforms import Pose, compose

if TYPE_CHECKING:
    from lxml import etree

    from executor.sdf.scopes import Scope

SIMPLE: Final = {
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
    "plane": ("size",),
}
"""Shapes that universes have, with the elements of their sizes."""
_COUNTS: Final = {("box", "size"): 3, ("plane", "size"): 2}
_BY_FILE: Final = ("mesh", "heightmap")
LARGE_M: Final = 20.0
NEAR: Final = 1e-4


@dataclass
class Part:
    """A visual or a collision; `pose` is in the world.

    `is_touched` says of a visual whether a collision is the same.
    """

    element: etree._Element
    shape: etree._Element
    tag: str
    size: list[float]
    pose: Pose
    friction: float | None = None
    is_touched: bool = False

    @property
    def is_ground(self) -> bool:
        """Whether it is a large plane at the height of the ground."""
        is_level = 1 - 2 * (self.pose[3] ** 2 + self.pose[4] ** 2) > 0.9999
        return self.tag == "plane" and min(self.size) >= LARGE_M and is_level and abs(self.pose[2]) < 0.05

    def is_like(self, other: Part) -> bool:
        """Returns whether another part has the same shape in the same place."""
        if self.tag != other.tag or math.dist(self.pose[:3], other.pose[:3]) > NEAR:
            return False
        if abs(sum(a * b for a, b in zip(self.pose[3:], other.pose[3:], strict=True))) < 1 - NEAR:
            return False
        if self.tag == "mesh":
            return _names(self.shape) == _names(other.shape) and self.size == other.size
        if self.tag == "plane":  # that of a collision has no end
            return True
        return all(abs(a - b) <= NEAR for a, b in zip(self.size, other.size, strict=True))


@dataclass
class LinkParts:
    """The parts of a link.

    Attributes:
        seen: its visuals.
        touched: its collisions.
        mass: its mass in kg.
        is_centred: whether its mass is in the middle of its only visual.
    """

    seen: list[Part]
    touched: list[Part]
    mass: float
    is_centred: bool

    @property
    def are_simple(self) -> bool:
        """Whether all is touched as it is seen, in shapes that universes have."""
        shapes = (*SIMPLE, *_BY_FILE)
        is_same = all(any(seen.is_like(part) for seen in self.seen) for part in self.touched)
        return is_same and all(part.tag in shapes for part in self.seen)


def parts_of(scope: Scope, link: etree._Element, at: Pose) -> LinkParts:
    """Returns the parts of a link of a model that stands at a pose in the world.

    Raises:
        SdfError: a value is malformed.
    """
    above = compose(at, scope.in_top())
    seen, touched = (
        [part for element in link.findall(tag) for part in _part(scope, link, element, above)]
        for tag in ("visual", "collision")
    )
    for part in seen:
        same = [other for other in touched if part.is_like(other)]
        part.is_touched = bool(same)
        part.friction = next((other.friction for other in same if other.friction is not None), None)
    inertial = link.find("inertial")
    own = link.get("name", "")
    centre = scope.frame(own) if inertial is None else scope.pose_of(inertial, own)
    is_centred = len(seen) == 1 and (
        inertial is None or math.dist(compose(above, centre)[:3], seen[0].pose[:3]) < 1e-3
    )
    return LinkParts(seen, touched, mass_of(inertial, scope.file), is_centred)


def _part(scope: Scope, link: etree._Element, element: etree._Element, above: Pose) -> list[Part]:
    shape = shape_of(element)
    if shape is None or shape.tag == "empty":
        return []
    tag = str(shape.tag)
    file = scope.file
    size = [
        value
        for key in SIMPLE.get(tag, ())
        for value in numbers(shape, key, _COUNTS.get((tag, key), 1), file)
    ]
    if tag == "mesh":
        size = numbers(shape, "scale", 3, file)
    elif tag == "heightmap":
        size = numbers(shape, "size", 3, file)
    pose = compose(above, scope.pose_of(element, link.get("name", "")))
    ode = element.find("surface/friction/ode")
    friction = numbers(ode, "mu", 1, file)[0] if ode is not None and text_of(ode, "mu") else None
    return [Part(element, shape, tag, size, compose(pose, turned(element, file)), friction)]


def _names(mesh: etree._Element) -> tuple[str, ...]:
    return text_of(mesh, "uri"), (mesh.findtext("submesh/name") or "").strip()
