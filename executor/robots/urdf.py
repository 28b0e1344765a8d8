"""Reads what we need of a URDF: links with their visual shapes, and the joints between them."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Final

from lxml import etree

from executor.world.transforms import IDENTITY, Pose, compose, from_xyz_rpy

_GREY: Final = (0.6, 0.6, 0.6, 1.0)
Rgba = tuple[float, float, float, float]


class UrdfError(Exception):
    """A URDF that cannot be used."""


@dataclass(frozen=True)
class Visual:
    """A visual shape in its link's frame; `size` as in `messages.Shape`."""

    shape: str
    size: tuple[float, ...]
    pose: Pose
    color: Rgba
    file: str = ""


@dataclass(frozen=True)
class Link:
    """A link and what one sees of it."""

    name: str
    visuals: tuple[Visual, ...]


@dataclass(frozen=True)
class Joint:
    """A joint; `axis` in the joint's frame, `origin` in the parent's."""

    name: str
    kind: str
    parent: str
    child: str
    origin: Pose
    axis: tuple[float, float, float]


@dataclass(frozen=True)
class Urdf:
    """A robot's tree of links; `text` is the document."""

    name: str
    root: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    text: str = ""

    @functools.cached_property
    def joint_above(self) -> dict[str, Joint]:
        """The joint that holds each link but the root."""
        return {joint.child: joint for joint in self.joints.values()}

    def rigid_parent(self, link: str) -> tuple[str, Pose]:
        """Returns the link that carries this one through fixed joints, and its pose in that link's frame."""
        pose = IDENTITY
        while (joint := self.joint_above.get(link)) is not None and joint.kind == "fixed":
            pose = compose(joint.origin, pose)
            link = joint.parent
        return link, pose


def parse_urdf(data: bytes, file: str = "robot.urdf") -> Urdf:
    """Returns the robot that a URDF describes.

    Raises:
        UrdfError: it is not well-formed, or not one tree of links.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise UrdfError(f"{file}:{error.lineno}: {error.msg}") from error
    if b"<!DOCTYPE" in data:
        raise UrdfError(f"{file}: a URDF needs no DOCTYPE")
    if root.tag != "robot":
        raise UrdfError(f"{file}:{root.sourceline}: the first element must be <robot>")
    try:
        colors = {
            m.get("name", ""): _color(m) for m in root.findall("material") if m.find("color") is not None
        }
        links = {link.get("name", ""): _link(link, colors) for link in root.findall("link")}
        joints = {joint.get("name", ""): _joint(joint) for joint in root.findall("joint")}
    except (ValueError, AttributeError, IndexError) as error:
        raise UrdfError(f"{file}: {error}") from error
    return Urdf(root.get("name", "robot"), _root_link(links, joints, file), links, joints, data.decode())


def _root_link(links: dict[str, Link], joints: dict[str, Joint], file: str) -> str:
    for joint in joints.values():
        for name in (joint.parent, joint.child):
            if name not in links:
                raise UrdfError(f"{file}: joint {joint.name!r} names the link {name!r}, which does not exist")
    children = {joint.child for joint in joints.values()}
    roots = [name for name in links if name not in children]
    if len(roots) != 1 or len(children) != len(joints):
        raise UrdfError(f"{file}: the links must form one tree; roots are {', '.join(roots) or 'none'}")
    return roots[0]


def _numbers(text: str) -> tuple[float, ...]:
    return tuple(float(word) for word in text.split())


def _origin(element: etree._Element) -> Pose:
    origin = element.find("origin")
    if origin is None:
        return IDENTITY
    xyz, rpy = _numbers(origin.get("xyz", "0 0 0")), _numbers(origin.get("rpy", "0 0 0"))
    if len(xyz) != 3 or len(rpy) != 3:
        raise ValueError(f"line {origin.sourceline}: an origin needs three numbers")
    return from_xyz_rpy((*xyz, *rpy))


def _color(material: etree._Element) -> Rgba:
    color = material.find("color")
    red, green, blue, alpha = _numbers(color.get("rgba", "")) if color is not None else _GREY
    return red, green, blue, alpha


def _link(element: etree._Element, colors: dict[str, Rgba]) -> Link:
    return Link(element.get("name", ""), tuple(_visual(v, colors) for v in element.findall("visual")))


def _visual(element: etree._Element, colors: dict[str, Rgba]) -> Visual:
    material = element.find("material")
    color = _GREY
    if material is not None:
        own = material.find("color") is not None
        color = _color(material) if own else colors.get(material.get("name", ""), _GREY)
    geometry = element.find("geometry")
    if geometry is None or len(geometry) == 0:
        raise ValueError(f"line {element.sourceline}: a visual needs a geometry")
    shape = geometry[0]
    kind = str(shape.tag)
    size, file = _size(kind, shape)
    return Visual(kind, size, _origin(element), color, file)


def _size(kind: str, shape: etree._Element) -> tuple[tuple[float, ...], str]:
    if kind == "box":
        return _numbers(shape.get("size", "")), ""
    if kind in ("cylinder", "capsule"):
        return (float(shape.get("radius", "")), float(shape.get("length", ""))), ""
    if kind == "sphere":
        return (float(shape.get("radius", "")),), ""
    if kind == "mesh":
        return _numbers(shape.get("scale", "1 1 1")), shape.get("filename", "")
    raise ValueError(f"line {shape.sourceline}: <{kind}> is not a shape")


def _joint(element: etree._Element) -> Joint:
    axis_element = element.find("axis")
    axis = _numbers(axis_element.get("xyz", "1 0 0")) if axis_element is not None else (1.0, 0.0, 0.0)
    parent, child = element.find("parent"), element.find("child")
    if parent is None or child is None or len(axis) != 3:
        raise ValueError(
            f"line {element.sourceline}: a joint needs parent, child and an axis of three numbers"
        )
    return Joint(
        element.get("name", ""),
        element.get("type", "fixed"),
        parent.get("link", ""),
        child.get("link", ""),
        _origin(element),
        (axis[0], axis[1], axis[2]),
    )
