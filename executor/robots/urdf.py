"""Parses the supported part of a URDF: links with visual shapes, and the joints between them."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeVar

import numpy as np
from lxml import etree

from executor.robots.inertia import Inertial
from executor.world.geometry.transforms import IDENTITY, Pose, compose, from_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")
_GREY: Final = (0.6, 0.6, 0.6, 1.0)
MOVING: Final = ("revolute", "continuous", "prismatic")
"""Kinds of joints that are simulated."""
Rgba = tuple[float, float, float, float]


class UrdfError(Exception):
    """A URDF cannot be used; `line` counts from 1."""

    def __init__(self, message: str, file: str, line: int = 1) -> None:
        self.message = message
        self.file = file
        self.line = line
        super().__init__(f"{file}:{line}: {message}")


class _WrongError(ValueError):
    """An error in an element."""

    def __init__(self, message: str, element: etree._Element) -> None:
        self.line = _line(element)
        super().__init__(message)


def _line(element: etree._Element) -> int:
    return int(str(element.sourceline))  # the type in lxml's stub includes an ellipsis


@dataclass(frozen=True)
class Visual:
    """A visual shape in the frame of its link; `size` is as in `messages.Shape`."""

    shape: str
    size: tuple[float, ...]
    pose: Pose
    color: Rgba
    file: str = ""


@dataclass(frozen=True)
class Link:
    """A link and its visual shapes."""

    name: str
    visuals: tuple[Visual, ...]


@dataclass(frozen=True)
class Joint:
    """A joint. `axis` is in the joint's frame, `origin` in the parent's frame, `limits` in rad or m."""

    name: str
    kind: str
    parent: str
    child: str
    origin: Pose
    axis: tuple[float, float, float]
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class Urdf:
    """A robot's tree of links; `text` is the URDF document."""

    name: str
    root: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    text: str = ""

    @functools.cached_property
    def joint_above(self) -> dict[str, Joint]:
        """Returns the joint above each link except the root."""
        return {joint.child: joint for joint in self.joints.values()}

    @functools.cached_property
    def mesh_files(self) -> dict[str, int]:
        """Returns the mesh files of visual and collision shapes, with the line of each."""
        meshes = etree.fromstring(self.text.encode()).iterfind("link/*/geometry/mesh")
        return {mesh.get("filename", ""): _line(mesh) for mesh in meshes}

    def rigid_parent(self, link: str) -> tuple[str, Pose]:
        """Returns the link that carries `link` through fixed joints only, and the pose of `link` in it."""
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
        raise UrdfError(str(error.msg), file, error.lineno or 1) from error
    if b"<!DOCTYPE" in data:
        raise UrdfError("a URDF needs no DOCTYPE", file)
    if root.tag != "robot":
        raise UrdfError("the first element must be <robot>", file, _line(root))
    try:
        materials = [m for m in root.findall("material") if m.find("color") is not None]
        colors = {m.get("name", ""): _color(m) for m in materials}
        links = _by_name(root, "link", lambda element: _link(element, colors))
        joints = _by_name(root, "joint", _joint)
        top = _root_link(root, links, joints)
    except _WrongError as error:
        raise UrdfError(str(error), file, error.line) from error
    text = etree.tostring(root, encoding="unicode")
    return Urdf(root.get("name", "robot"), top, links, joints, text)


def _by_name(root: etree._Element, tag: str, make: Callable[[etree._Element], T]) -> dict[str, T]:
    found: dict[str, T] = {}
    for element in root.findall(tag):
        name = element.get("name", "")
        if not name or name in found:
            raise _WrongError(
                f"the {tag} {name!r} is defined twice" if name else f"a {tag} needs a name", element
            )
        found[name] = make(element)
    return found


def _root_link(root: etree._Element, links: dict[str, Link], joints: dict[str, Joint]) -> str:
    children: set[str] = set()
    for element in root.findall("joint"):
        joint = joints[element.get("name", "")]
        for name in (joint.parent, joint.child):
            if name not in links:
                raise _WrongError(
                    f"joint {joint.name!r} names the link {name!r}, which does not exist", element
                )
        if joint.child in children:
            raise _WrongError(f"the links must form one tree, but {joint.child!r} has two parents", element)
        children.add(joint.child)
    roots = [name for name in links if name not in children]
    if len(roots) != 1:
        raise _WrongError(f"the links must form one tree; roots are {', '.join(roots) or 'none'}", root)
    return roots[0]


def _numbers(element: etree._Element, key: str, default: str = "", *, count: int = 0) -> tuple[float, ...]:
    text = element.get(key, default)
    try:
        values = tuple(float(word) for word in text.split())
    except ValueError:
        values = ()
    if not values or (count and len(values) != count) or not all(map(math.isfinite, values)):
        what = {1: "a number", 3: "three numbers", 4: "four numbers"}.get(count, "numbers")
        raise _WrongError(f"<{element.tag}> needs {what} as {key!r}, not {text!r}", element)
    return values


def read_origin(element: etree._Element) -> Pose:
    """Returns the pose of an element's `<origin>`; without one, the identity."""
    origin = element.find("origin")
    if origin is None:
        return IDENTITY
    xyz = _numbers(origin, "xyz", "0 0 0", count=3)
    rpy = _numbers(origin, "rpy", "0 0 0", count=3)
    return from_xyz_rpy((*xyz, *rpy))


def read_inertial(link: etree._Element) -> Inertial | None:
    """Returns the inertia of a link; None if the URDF gives none."""
    element = link.find("inertial")
    if element is None:
        return None
    mass, inertia = element.find("mass"), element.find("inertia")
    if mass is None or inertia is None:
        raise _WrongError("<inertial> needs a <mass> and an <inertia>", element)
    xx, xy, xz, yy, yz, zz = (
        _numbers(inertia, key, "0", count=1)[0] for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    )
    [kilograms] = _numbers(mass, "value", count=1)
    if kilograms < 0 or min(xx, yy, zz) < 0:
        raise _WrongError("a mass and moments of inertia cannot be less than 0", element)
    return Inertial(kilograms, read_origin(element), np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))


def _color(material: etree._Element) -> Rgba:
    color = material.find("color")
    red, green, blue, alpha = _numbers(color, "rgba", count=4) if color is not None else _GREY
    return red, green, blue, alpha


def _link(element: etree._Element, colors: dict[str, Rgba]) -> Link:
    read_inertial(element)
    for collision in element.findall("collision"):
        read_origin(collision)
    return Link(element.get("name", ""), tuple(_visual(v, colors) for v in element.findall("visual")))


def _visual(element: etree._Element, colors: dict[str, Rgba]) -> Visual:
    material = element.find("material")
    color = _GREY
    if material is not None:
        own = material.find("color") is not None
        color = _color(material) if own else colors.get(material.get("name", ""), _GREY)
    geometry = element.find("geometry")
    if geometry is None or len(geometry) == 0:
        raise _WrongError("a visual needs a geometry", element)
    shape = geometry[0]
    kind = str(shape.tag)
    size, file = _size(kind, shape)
    return Visual(kind, size, read_origin(element), color, file)


def _size(kind: str, shape: etree._Element) -> tuple[tuple[float, ...], str]:
    if kind == "box":
        return _numbers(shape, "size", count=3), ""
    if kind in ("cylinder", "capsule"):
        return (*_numbers(shape, "radius", count=1), *_numbers(shape, "length", count=1)), ""
    if kind == "sphere":
        return _numbers(shape, "radius", count=1), ""
    if kind == "mesh":
        return _numbers(shape, "scale", "1 1 1", count=3), shape.get("filename", "")
    raise _WrongError(f"<{kind}> is not a shape", shape)


def _joint(element: etree._Element) -> Joint:
    axis_element = element.find("axis")
    axis = _numbers(axis_element, "xyz", count=3) if axis_element is not None else (1.0, 0.0, 0.0)
    parent, child = element.find("parent"), element.find("child")
    if parent is None or child is None:
        raise _WrongError("a joint needs a parent and a child", element)
    kind, limit = element.get("type", "fixed"), element.find("limit")
    limits = None
    if limit is not None and kind in ("revolute", "prismatic"):
        limits = tuple(_numbers(limit, key, "0", count=1)[0] for key in ("lower", "upper"))
    return Joint(
        element.get("name", ""),
        kind,
        parent.get("link", ""),
        child.get("link", ""),
        read_origin(element),
        (axis[0], axis[1], axis[2]),
        None if limits is None else (limits[0], limits[1]),
    )
