"""Parses the supported part of a URDF: links with visual shapes, and the joints between them."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, TypeVar

import numpy as np
from lxml import etree

from executor.robots.inertia import Inertial
from executor.robots.surfaces import read_frictions
from executor.universes.document import Problem
from executor.world.geometry.transforms import IDENTITY, Pose, compose, from_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")
_GREY: Final = (0.6, 0.6, 0.6, 1.0)
MOVING: Final = ("revolute", "continuous", "prismatic")
"""Kinds of joints that are simulated."""
MOST_LINKS: Final = 1_000
LIMITED: Final = ("revolute", "prismatic")
"""Kinds of joints that need limits."""
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
    """A visual shape in the frame of its link; `size` is as in `messages.Shape`.

    `is_plain` is whether the URDF says no colour, so that those of a mesh's file are shown.
    """

    shape: str
    size: tuple[float, ...]
    pose: Pose
    color: Rgba
    file: str = ""
    is_plain: bool = False


@dataclass(frozen=True)
class Link:
    """A link and its visual shapes."""

    name: str
    visuals: tuple[Visual, ...]


@dataclass(frozen=True)
class Mimic:
    """A joint's position follows that of `joint`: `multiplier` · position + `offset`, in rad or m."""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Joint:
    """A joint.

    `axis` is a unit vector in the joint's frame, `origin` is in the parent's frame, `limits` are in rad or m,
    `effort` is in Nm or N.
    """

    name: str
    kind: str
    parent: str
    child: str
    origin: Pose
    axis: tuple[float, float, float]
    limits: tuple[float, float] | None = None
    effort: float | None = None
    friction: float = 0.0
    mimic: Mimic | None = None


@dataclass(frozen=True)
class Urdf:
    """A robot's tree of links.

    Args:
        text: the URDF document.
        friction: the friction that the document gives to links.
        notes: what is left out or replaced, with lines of the document.
    """

    name: str
    root: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    text: str = ""
    friction: dict[str, float] = field(default_factory=dict)
    notes: tuple[Problem, ...] = ()

    @functools.cached_property
    def joint_above(self) -> dict[str, Joint]:
        """Returns the joint above each link except the root."""
        return {joint.child: joint for joint in self.joints.values()}

    @functools.cached_property
    def mesh_files(self) -> dict[str, int]:
        """Returns the mesh files of visual and collision shapes, with the line of each."""
        return self._meshes("*")

    @functools.cached_property
    def touched_meshes(self) -> dict[str, int]:
        """Returns the mesh files of collision shapes, with the line of each."""
        return self._meshes("collision")

    def _meshes(self, parts: str) -> dict[str, int]:
        meshes = etree.fromstring(self.text.encode()).iterfind(f"link/{parts}/geometry/mesh")
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
    beyond = root.findall("link")[MOST_LINKS:]
    if beyond:
        count = MOST_LINKS + len(beyond)
        raise UrdfError(f"a robot has at most {MOST_LINKS} links; this has {count}", file, _line(beyond[0]))
    try:
        materials = [m for m in root.findall("material") if m.find("color") is not None]
        colors = {m.get("name", ""): _color(m) for m in materials}
        links = _by_name(root, "link", lambda element: _link(element, colors))
        joints = _by_name(root, "joint", _joint)
        top = _root_link(root, links, joints)
        _check_mimics(root, joints)
    except _WrongError as error:
        raise UrdfError(str(error), file, error.line) from error
    text = etree.tostring(root, encoding="unicode")
    friction, notes = read_frictions(root)
    notes += _weightless(root, joints)
    return Urdf(root.get("name", "robot"), top, links, joints, text, friction, tuple(notes))


def _weightless(root: etree._Element, joints: dict[str, Joint]) -> list[Problem]:
    """Returns a note for each link with a mass of 0 that is not a fixed part of another one."""
    fixed = {joint.child for joint in joints.values() if joint.kind == "fixed"}
    return [
        Problem(
            f"the link {link.get('name', '')!r} has the mass 0, which no force can move: it gets 1 g; "
            "write its mass in kg",
            _line(mass),
            code="BTR005",
        )
        for link in root.iterfind("link")
        if link.get("name", "") not in fixed
        for mass in link.iterfind("inertial/mass")
        if float(mass.get("value", "1")) == 0
    ]


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
    color: Rgba | None = None
    if material is not None:
        own = material.find("color") is not None
        color = _color(material) if own else colors.get(material.get("name", ""))
    kind, size, file = read_shape(element)
    return Visual(kind, size, read_origin(element), color or _GREY, file, color is None)


def read_shape(element: etree._Element) -> tuple[str, tuple[float, ...], str]:
    """Returns the shape of a `<visual>` or `<collision>`: its kind, its size and the file of a mesh."""
    shape = next(element.iterfind("geometry/*"), None)
    if shape is None:
        raise _WrongError(f"a {element.tag} needs a geometry", element)
    kind = str(shape.tag)
    return kind, *_size(kind, shape)


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
    name, kind = element.get("name", ""), element.get("type", "fixed")
    parent, child = element.find("parent"), element.find("child")
    if parent is None or child is None:
        raise _WrongError("a joint needs a parent and a child", element)
    if kind not in (*MOVING, "fixed"):
        kinds = "fixed, revolute, continuous or prismatic"
        raise _WrongError(f"the joint {name!r} is {kind!r}: joints are {kinds} here", element)
    limits, effort = _limits(element, name, kind)
    dynamics = element.find("dynamics")
    return Joint(
        name,
        kind,
        parent.get("link", ""),
        child.get("link", ""),
        read_origin(element),
        read_axis(element) if kind in MOVING else (1.0, 0.0, 0.0),
        limits,
        effort,
        0.0 if dynamics is None else _not_negative(dynamics, "friction", name),
        _mimic(element, name),
    )


def read_axis(joint: etree._Element) -> tuple[float, float, float]:
    """Returns the axis of a joint as a unit vector: its length has no meaning."""
    element = joint.find("axis")
    if element is None:
        return (1.0, 0.0, 0.0)
    x, y, z = _numbers(element, "xyz", count=3)
    length = math.hypot(x, y, z)
    if length == 0.0:
        raise _WrongError(
            f"the axis of the joint {joint.get('name')!r} is 0 0 0: an axis needs a direction", element
        )
    return (x / length, y / length, z / length)


def _limits(element: etree._Element, name: str, kind: str) -> tuple[tuple[float, float] | None, float | None]:
    """Returns the limits and the effort of a joint, by the rules of ROS's own parser."""
    limit, controller = element.find("limit"), element.find("safety_controller")
    if controller is not None and controller.get("k_velocity") is None:
        text = f"the <safety_controller> of the joint {name!r} needs k_velocity"
        raise _WrongError(text, controller)
    if limit is None:
        if kind in LIMITED:
            needs = "<limit> with lower, upper, effort and velocity"
            raise _WrongError(f"the joint {name!r} is {kind}, so it needs a {needs}", element)
        return None, None
    for key in ("effort", "velocity"):
        if limit.get(key) is None:
            raise _WrongError(f"the <limit> of the joint {name!r} needs {key}", limit)
    effort, _ = (_not_negative(limit, key, name) for key in ("effort", "velocity"))
    lower, upper = (_numbers(limit, key, "0", count=1)[0] for key in ("lower", "upper"))
    if kind not in LIMITED:
        return None, effort
    if lower > upper:
        text = f"the <limit> of the joint {name!r} has lower {lower:g}, which is above upper {upper:g}"
        raise _WrongError(text, limit)
    return (lower, upper), effort


def _mimic(element: etree._Element, name: str) -> Mimic | None:
    mimic = element.find("mimic")
    if mimic is None:
        return None
    followed = mimic.get("joint", "")
    if not followed:
        raise _WrongError(f"the <mimic> of the joint {name!r} needs joint", mimic)
    [multiplier], [offset] = (
        _numbers(mimic, key, default, count=1) for key, default in (("multiplier", "1"), ("offset", "0"))
    )
    return Mimic(followed, multiplier, offset)


def _not_negative(element: etree._Element, key: str, joint: str) -> float:
    [value] = _numbers(element, key, "0", count=1)
    if value < 0:
        raise _WrongError(f"{key} of the joint {joint!r} cannot be less than 0", element)
    return value


def _check_mimics(root: etree._Element, joints: dict[str, Joint]) -> None:
    """Checks that each `<mimic>` names a joint that moves, and that none follows itself."""
    for element in root.findall("joint/mimic"):
        joint = joints[element.getparent().get("name", "")]  # type: ignore[union-attr]
        seen = [joint.name]
        while (mimic := joint.mimic) is not None:
            if mimic.joint not in joints or joints[mimic.joint].kind not in MOVING:
                why = "is fixed" if mimic.joint in joints else "does not exist"
                text = f"the joint {joint.name!r} follows {mimic.joint!r}, which {why}"
                raise _WrongError(text, element)
            if mimic.joint in seen:
                raise _WrongError(f"the joint {seen[0]!r} follows itself", element)
            seen.append(mimic.joint)
            joint = joints[mimic.joint]
