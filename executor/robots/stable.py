"""Joints as the physics engine can simulate them: axes of length 1, and damping that stays stable.

The engine applies a joint's damping explicitly: the torque of one step is that of the rate before it. With a
light link and much damping the rate changes its sign in each step and grows without bound. The damping is
therefore replaced by the one that has the same effect in one step as the exact solution for the link alone,
`I / dt · (1 - exp(-d · dt / I))`, which never exceeds what stops the link.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.robots.urdf import MOVING, read_axis, read_inertial
from executor.world.geometry.transforms import rotation

if TYPE_CHECKING:
    from lxml import etree

STEP_S: Final = 1.0 / 240.0


def settle_joints(root: etree._Element) -> None:
    """Sets the axes and the damping of the joints of a URDF in place; each link has an inertia."""
    links = {link.get("name", ""): link for link in root.findall("link")}
    for joint in root.findall("joint"):
        if joint.get("type") not in MOVING:
            continue
        axis = read_axis(joint)
        element = joint.find("axis")
        if element is not None:
            element.set("xyz", " ".join(map(repr, axis)))
        dynamics, child = joint.find("dynamics"), joint.find("child")
        if dynamics is not None and child is not None and dynamics.get("damping") is not None:
            inertia = _about(links[child.get("link", "")], axis, slides=joint.get("type") == "prismatic")
            damping = float(dynamics.get("damping", "0"))
            dynamics.set("damping", repr(bounded_damping(damping, inertia)))


def bounded_damping(damping: float, inertia: float, step_s: float = STEP_S) -> float:
    """Returns the damping for explicit steps that acts as `damping` does; inertia in kg m² or kg."""
    if damping <= 0 or inertia <= 0:
        return 0.0
    return -math.expm1(-damping * step_s / inertia) * inertia / step_s


def _about(link: etree._Element, axis: tuple[float, float, float], *, slides: bool) -> float:
    """Returns the inertia of a link about the axis of its joint in kg m², or its mass in kg if it slides."""
    inertial = read_inertial(link)
    if inertial is None:
        return 0.0
    if slides:
        return inertial.mass
    turned, along = rotation(inertial.pose[3:]), np.array(axis)
    tensor = turned @ inertial.tensor @ turned.T
    arm = np.cross(along, inertial.pose[:3])
    return float(along @ tensor @ along + inertial.mass * (arm @ arm))
