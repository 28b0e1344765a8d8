"""Merges links that are fixed to each other, since each link costs time in each physics step.

Renderer and sensors use the original URDF; only the physics server gets the merged one. The dynamics do not
change: collision shapes move to the link that carries them, masses are joined exactly.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from lxml import etree

from executor.robots.urdf import read_inertial, read_origin
from executor.world.geometry.transforms import compose, to_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Collection

    from executor.robots.inertia import Inertial
    from executor.world.geometry.transforms import Pose

_TENSOR = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}


def merge_fixed_links(root: etree._Element, apart: Collection[str]) -> None:
    """Merges each link in place with the link that it is fixed to.

    Args:
        root: the URDF, valid.
        apart: links that are not merged, since their contacts or friction are needed separately.
    """
    links = {link.get("name", ""): link for link in root.findall("link")}
    joints = root.findall("joint")
    for joint in joints:
        child, parent = (links[_link_of(joint, end)] for end in ("child", "parent"))
        if joint.get("type") != "fixed" or any(_stands_apart(link, apart) for link in (child, parent)):
            continue
        pose = read_origin(joint)
        _move_collisions(child, parent, pose)
        _join_masses(child, parent, pose)
        for below in joints:
            if _link_of(below, "parent") == child.get("name"):
                _set_origin(below, compose(pose, read_origin(below)))
                _end(below, "parent").set("link", parent.get("name", ""))
        root.remove(child)
        root.remove(joint)


def _stands_apart(link: etree._Element, apart: Collection[str]) -> bool:
    # <contact> is Bullet's extension of URDF: the contact properties of this link.
    return link.get("name") in apart or link.find("contact") is not None


def _end(joint: etree._Element, end: str) -> etree._Element:
    found = joint.find(end)
    if found is None:
        raise ValueError(f"joint {joint.get('name')!r} has no {end}")
    return found


def _link_of(joint: etree._Element, end: str) -> str:
    return _end(joint, end).get("link", "")


def _move_collisions(child: etree._Element, parent: etree._Element, pose: Pose) -> None:
    for collision in child.findall("collision"):
        _set_origin(collision, compose(pose, read_origin(collision)))
        parent.append(collision)


def _join_masses(child: etree._Element, parent: etree._Element, pose: Pose) -> None:
    own, added = read_inertial(parent), read_inertial(child)
    if added is None:
        return
    joined = added.seen_from(pose)
    if own is not None:
        joined = own.joined(joined)
        for element in parent.findall("inertial"):
            parent.remove(element)
    parent.insert(0, _inertial_element(joined))


def _inertial_element(inertial: Inertial) -> etree._Element:
    element = etree.Element("inertial")
    _set_origin(element, inertial.pose)
    etree.SubElement(element, "mass", value=repr(inertial.mass))
    tensor = {name: repr(float(inertial.tensor[at])) for name, at in _TENSOR.items()}
    etree.SubElement(element, "inertia", tensor)
    return element


def _set_origin(element: etree._Element, pose: Pose) -> None:
    origin = element.find("origin")
    if origin is None:
        origin = etree.Element("origin")
        element.insert(0, origin)
    numbers = [repr(float(value)) for value in to_xyz_rpy(pose)]
    origin.set("xyz", " ".join(numbers[:3]))
    origin.set("rpy", " ".join(numbers[3:]))
