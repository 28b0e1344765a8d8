"""Makes a URDF from an SDF model: links with visual and collision shapes, and joints.

The frame of a URDF link is at its joint, while that of an SDF link can be anywhere. So every pose is first
computed in the frame of the model. The pose of the model itself is ignored, since the universe places the
model. Models in the model are part of it; the names of their links begin with theirs.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, NamedTuple

from lxml import etree

from executor.robots.urdf import UrdfError
from executor.sdf.dialect import SdfError, line_of
from executor.sdf.files import NoFiles
from executor.sdf.includes import file_of, is_before, load, problem_at
from executor.sdf.scopes import SEPARATOR, Scope
from executor.sdf.values import NO_INERTIA, NO_INERTIAL_MASS, is_true, numbers, text_of
from executor.world.geometry.transforms import (
    IDENTITY,
    Pose,
    compose,
    inverse,
    quaternion_about,
    rotate,
    to_xyz_rpy,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Sequence

    from executor.sdf.files import Files
    from executor.universes.document import Problem

PLANE_THICKNESS_M: Final = 0.002
LINE: Final = "bt-studio-line"
"""Attribute of an element that is copied: its line in the SDF."""
ENDLESS: Final = 1e6
"""Limits above this value mean "no limit"."""
WORLD: Final = "world"
_QUIET: Final = frozenset(
    {"pose", "static", "link", "joint", "frame", "model", "self_collide", "allow_auto_disable", "enable_wind"}
)
_LINK_QUIET: Final = frozenset(
    {"pose", "inertial", "visual", "collision", "gravity", "kinematic", "self_collide", "velocity_decay"}
    | {"enable_wind", "must_be_base_link"}
)
_KINDS: Final = {
    "revolute": "revolute",
    "continuous": "continuous",
    "prismatic": "prismatic",
    "fixed": "fixed",
}


@dataclass
class Made:
    """A URDF made from SDF, and the parts of the SDF that were left out."""

    urdf: bytes
    left_out: list[Problem] = field(default_factory=list)


def urdf_of_sdf(data: bytes, file: str = "model.sdf", files: Files | None = None) -> Made:
    """Returns the URDF of the first model of an SDF document, with the models that it includes.

    Raises:
        UrdfError: the document is not an SDF with a model, or is invalid.
    """
    left_out: list[Problem] = []

    def skip(element: etree._Element, message: str) -> None:
        left_out.append(problem_at(element, message))

    def mesh(shape: etree._Element) -> tuple[str, Sequence[float]]:
        if shape.find("submesh") is not None:
            skip(shape, "<submesh> is not read here: the whole mesh is taken")
        return text_of(shape, "uri").replace("model://", "package://", 1), _scale(shape)

    try:
        root = load(data, file, files or NoFiles(), skip)
        model = root.find("model")
        if model is None:
            raise SdfError("there is no <model> in an <sdf> element", file)
        urdf = SdfUrdf(Scope(model), mesh, skip).made()
    except SdfError as error:
        raise UrdfError(error.problem.message, error.file, error.problem.line) from error
    return Made(urdf, sorted(left_out, key=lambda problem: problem.line))


class Joint(NamedTuple):
    """A joint of a model; `parent` is a link, or the world."""

    name: str
    scope: Scope
    element: etree._Element
    parent: str
    child: str

    @property
    def kind(self) -> str:
        """Its type in URDF; "" for those that URDF does not have."""
        return _KINDS.get(self.element.get("type", ""), "")


def links_of(model: Scope) -> dict[str, tuple[Scope, etree._Element]]:
    """Returns the links of a model and of the models in it, by their names."""
    return {
        _full(model, scope, name): (scope, link)
        for scope in model.walk()
        for name, link in scope.links.items()
    }


def joints_of(model: Scope) -> list[Joint]:
    """Returns the joints of a model and of the models in it, between their links.

    Raises:
        SdfError: a joint names a link that does not exist.
    """
    made = []
    for scope in model.walk():
        for name, joint in scope.joints.items():
            ends = []
            for tag in ("parent", "child"):
                found = scope.link_of(text_of(joint, tag), joint)
                ends.append(WORLD if found is None else _full(model, *found))
            made.append(Joint(_full(model, scope, name), scope, joint, *ends))
    return made


def _full(model: Scope, scope: Scope, name: str) -> str:
    return SEPARATOR.join((*scope.path[len(model.path) :], name))


class SdfUrdf:
    """Writes links of a model as a URDF.

    Args:
        model: the model.
        mesh: names a mesh.
        skip: is called with each element that is left out.
        only: the links to write; all, if it is None.
        is_fixed: whether nothing of it moves, so that meshes need not be convex.
    """

    def __init__(
        self,
        model: Scope,
        mesh: Callable[[etree._Element], tuple[str, Sequence[float]] | None],
        skip: Callable[[etree._Element, str], None],
        only: Collection[str] | None = None,
        *,
        is_fixed: bool = False,
    ) -> None:
        self._model = model
        self._mesh = mesh
        self._skip = skip
        self._is_fixed = is_fixed
        self._is_whole = only is None
        self._links = {name: found for name, found in links_of(model).items() if only is None or name in only}
        if not self._links:
            raise SdfError("a model needs a link", model.file, line_of(model.element))
        self._joints = [
            joint
            for joint in joints_of(model)
            if joint.child in self._links and (joint.parent in self._links or joint.parent == WORLD)
        ]
        self._above = self._tree()

    def made(self) -> bytes:
        """Returns the URDF."""
        robot = etree.Element("robot", name=self._model.name)
        if any(joint.parent == WORLD for joint in self._above.values()):
            etree.SubElement(robot, "link", name=WORLD)
        for name, (scope, link) in self._links.items():
            robot.append(self._link(name, scope, link))
        roots = [name for name in self._links if name not in self._above]
        first = WORLD if robot[0].get("name") == WORLD else roots[0]
        for name, (_, link) in self._links.items():
            joint = self._above.get(name)
            if joint is not None:
                robot.append(self._joint(joint))
            elif name != first:
                if not self._is_fixed:
                    self._skip(link, f"no joint holds the link {name!r}: it is fastened to {first!r}")
                robot.append(self._joint_element(f"{name}_to_{first}", "fixed", first, name))
        robot.extend(self._surfaces())
        if self._is_whole:
            robot.extend(self._for_gazebo())
        for scope in self._model.walk():
            for child in scope.element:
                if isinstance(child.tag, str) and child.tag not in _QUIET:
                    self._skip(child, f"<{child.tag}> of the model is not simulated")
        return etree.tostring(robot, pretty_print=True)

    def mass(self) -> float:
        """Returns the mass of all links."""
        inertials = ((scope, link.find("inertial")) for scope, link in self._links.values())
        return sum(mass_of(inertial, scope.file) for scope, inertial in inertials)

    def _tree(self) -> dict[str, Joint]:
        """Returns the joint above each link, by link.

        Fixed joints to the world, and those that would close a loop, are left out.
        """
        above: dict[str, Joint] = {}
        for joint in self._joints:
            if joint.parent == WORLD and (joint.kind in ("", "fixed") or joint.element.find("axis") is None):
                continue  # Bullet fixes a root without mass
            if joint.child in above or joint.child in self._ancestors(joint.parent, above):
                self._skip(joint.element, f"the joint {joint.name!r} closes a loop")
                continue
            above[joint.child] = joint
        return above

    @staticmethod
    def _ancestors(link: str, above: dict[str, Joint]) -> Iterator[str]:
        yield link
        while link in above:
            link = above[link].parent
            yield link

    def _link_frame(self, link: str) -> Pose:
        """Returns a link's frame in the URDF: at its joint, or at the model's origin if it has no joint."""
        joint = self._above.get(link)
        return IDENTITY if joint is None else self._in_model(joint.scope, joint.element.get("name", ""))

    @staticmethod
    def _in_model(scope: Scope, frame: str) -> Pose:
        return compose(scope.in_top(), scope.frame(frame))

    def _link(self, name: str, scope: Scope, link: etree._Element) -> etree._Element:
        made = etree.Element("link", name=name)
        frame = compose(inverse(self._link_frame(name)), scope.in_top())
        own = link.get("name", "")
        inertial = link.find("inertial")
        made.append(self._inertial(scope, inertial, compose(frame, self._inertial_pose(scope, link, own))))
        for tag in ("visual", "collision"):
            for part in link.findall(tag):
                geometry = self._geometry(part)
                if geometry is None:
                    continue
                element = etree.SubElement(made, tag)
                if tag == "collision" and self._is_fixed and geometry.find("mesh") is not None:
                    element.set("concave", "yes")
                pose = compose(frame, scope.pose_of(part, own))
                element.append(_origin(compose(pose, turned(part, scope.file))))
                element.append(geometry)
                if tag == "visual":
                    element.append(self._material(part))
        for found in link:
            if isinstance(found.tag, str) and found.tag not in _LINK_QUIET:
                self._skip(found, f"<{found.tag}> of the link {name!r} is not simulated")
        if not is_true(link, "gravity", default=True):
            self._skip(link, f"the link {name!r} has no gravity there, but has it here")
        return made

    @staticmethod
    def _inertial_pose(scope: Scope, link: etree._Element, own: str) -> Pose:
        inertial = link.find("inertial")
        return scope.frame(own) if inertial is None else scope.pose_of(inertial, own)

    def _inertial(self, scope: Scope, inertial: etree._Element | None, pose: Pose) -> etree._Element:
        made = etree.Element("inertial")
        made.append(_origin(pose))
        etree.SubElement(made, "mass", value=f"{mass_of(inertial, scope.file):.9g}")
        values = dict(NO_INERTIA)
        if inertial is not None:
            if not numbers(inertial, "mass", 1, scope.file)[0] > 0:
                text = "a link has the mass 0, which no force can move: it gets 0.1 g; write its mass in kg"
                self._skip(inertial, text)
            if inertial.get("auto", "").strip().lower() in ("true", "1"):
                self._skip(inertial, "the mass of a link is not computed from its shapes: it is 1 kg")
            inertia = inertial.find("inertia")
            for value in inertia if inertia is not None else ():
                if isinstance(value.tag, str) and value.tag in values and (value.text or "").strip():
                    assert inertia is not None  # noqa: S101 - it has this child
                    values[value.tag] = numbers(inertia, value.tag, 1, scope.file)[0]
        etree.SubElement(made, "inertia", {name: f"{value:.9g}" for name, value in values.items()})
        return made

    def _geometry(self, part: etree._Element) -> etree._Element | None:
        shape = shape_of(part)
        if shape is None:
            return None
        file = file_of(part)
        made = etree.Element("geometry")
        match shape.tag:
            case "box":
                etree.SubElement(made, "box", size=_words(numbers(shape, "size", 3, file)))
            case "plane":
                size = numbers(shape, "size", 2, file)
                etree.SubElement(made, "box", size=_words([*size, PLANE_THICKNESS_M]))
            case "sphere":
                etree.SubElement(made, "sphere", radius=_words(numbers(shape, "radius", 1, file)))
            case "cylinder" | "capsule":
                keys = {key: _words(numbers(shape, key, 1, file)) for key in ("radius", "length")}
                etree.SubElement(made, str(shape.tag), keys)
            case "mesh":
                named = self._mesh(shape)
                if named is None:
                    return None
                etree.SubElement(made, "mesh", filename=named[0], scale=_words(named[1]))
            case "empty":
                return None
            case _:
                self._skip(shape, f"<{shape.tag}> is no shape that we have")
                return None
        return made

    def _for_gazebo(self) -> Iterator[etree._Element]:
        """Yields sensors and plugins as URDF writes them, each with its line: an import reads them."""
        found = [(name, each) for name, (_, link) in self._links.items() for each in link.findall("sensor")]
        found += [("", plugin) for plugin in self._model.element.findall("plugin")]
        for name, element in found:
            made = etree.Element("gazebo", {"reference": name} if name else {})
            copied = copy.deepcopy(element)
            copied.set(LINE, str(element.sourceline))
            made.append(copied)
            yield made

    def _surfaces(self) -> Iterator[etree._Element]:
        """Yields the friction of links as URDF writes it; a link that hangs on a ball joint slides."""
        rolls = {joint.child for joint in self._joints if joint.element.get("type") == "ball"}
        for name, (_, link) in self._links.items():
            surfaces = link.findall("collision/surface/friction/ode")
            found = [(surface.find("mu"), surface.find("mu2")) for surface in surfaces]
            values = {tuple("" if e is None else (e.text or "").strip() for e in pair) for pair in found}
            if name in rolls:
                self._skip(link, f"the link {name!r} is a ball castor: it slides without friction here")
                values = {("0", "0")}
            elif len(values) > 1:
                self._skip(surfaces[1], f"the collisions of the link {name!r} have different friction")
            if values and any(first := min(values)):
                made = etree.Element("gazebo", reference=name)
                for tag, value in zip(("mu1", "mu2"), first, strict=True):
                    if value:
                        etree.SubElement(made, tag).text = value
                yield made

    def _material(self, visual: etree._Element) -> etree._Element:
        material = etree.Element("material", name="")
        for key in ("diffuse", "ambient"):
            found = visual.find(f"material/{key}")
            if found is not None:
                values = [float(word) for word in (found.text or "").split() if _is_number(word)]
                if len(values) in (3, 4):
                    shown = [min(max(value, 0.0), 1.0) for value in [*values, 1.0][:4]]
                    etree.SubElement(material, "color", rgba=_words(shown))
                    break
        return material

    def _joint(self, joint: Joint) -> etree._Element:
        kind = joint.kind
        if not kind:
            said = joint.element.get("type") or "of no type"
            self._skip(joint.element, f"the joint {joint.name!r} is {said}: it is fixed here")
            kind = "fixed"
        made = self._joint_element(joint.name, kind, joint.parent, joint.child)
        axis = joint.element.find("axis")
        if kind == "fixed" or axis is None:
            made.set("type", "fixed")
            return made
        file = joint.scope.file
        etree.SubElement(made, "axis", xyz=_words(self._axis(joint, axis)))
        limit = axis.find("limit")
        ends = [self._limit(limit, key, sign, file) for key, sign in (("lower", -1), ("upper", 1))]
        most = {key: self._limit(limit, key, 1, file) for key in ("effort", "velocity")}
        most = {
            key: value if 0 <= value < ENDLESS else otherwise
            for (key, value), otherwise in zip(most.items(), (1000.0, 100.0), strict=True)
        }
        keys = {key: f"{value:.9g}" for key, value in most.items()}
        if max(map(abs, ends)) >= ENDLESS and kind == "revolute":
            made.set("type", "continuous")
        elif kind != "continuous":
            keys |= {"lower": f"{ends[0]:.9g}", "upper": f"{ends[1]:.9g}"}
        etree.SubElement(made, "limit", keys)
        self._dynamics(made, joint, axis.find("dynamics"))
        self._mimic(made, joint, axis.find("mimic"))
        return made

    def _dynamics(self, made: etree._Element, joint: Joint, dynamics: etree._Element | None) -> None:
        if dynamics is None:
            return
        keys = [key for key in ("damping", "friction") if text_of(dynamics, key)]
        values = {key: _words(numbers(dynamics, key, 1, joint.scope.file)) for key in keys}
        etree.SubElement(made, "dynamics", values)
        if text_of(dynamics, "spring_stiffness") not in ("", "0", "0.0"):
            self._skip(dynamics, f"the spring of the joint {joint.name!r} is not simulated")

    def _mimic(self, made: etree._Element, joint: Joint, mimic: etree._Element | None) -> None:
        if mimic is None:
            return
        other = mimic.get("joint", "").replace("__model__", "")
        names = {each.name for each in self._joints}
        if other not in names:
            self._skip(mimic, f"the joint {joint.name!r} follows {other!r}, which does not exist")
            return
        file = joint.scope.file
        factor, offset, reference = (
            numbers(mimic, key, 1, file)[0] for key in ("multiplier", "offset", "reference")
        )
        keys = {"multiplier": f"{factor:.9g}", "offset": f"{offset - factor * reference:.9g}"}
        etree.SubElement(made, "mimic", {"joint": other, **keys})

    @staticmethod
    def _axis(joint: Joint, axis: etree._Element) -> Sequence[float]:
        """Returns the axis of a joint in the joint's frame, with length 1."""
        scope, own = joint.scope, joint.element.get("name", "")
        xyz = axis.find("xyz")
        values = numbers(axis, "xyz", 3, scope.file)
        length = math.hypot(*values)
        if length == 0.0:
            place = axis if xyz is None else xyz
            text = f"the axis of the joint {own!r} is 0 0 0: an axis needs a direction"
            raise SdfError(text, file_of(place), line_of(place))
        values = [value / length for value in values]
        said = xyz.get("expressed_in") if xyz is not None else None
        if not said and (is_true(axis, "use_parent_model_frame") or is_before(axis, 1, 5)):
            said = "__model__"
        if said:
            turn = compose(inverse(scope.frame(own)), scope.frame(said, (), axis))
            return rotate(turn[3:], values)
        return values

    @staticmethod
    def _limit(limit: etree._Element | None, key: str, sign: int, file: str) -> float:
        if limit is None or text_of(limit, key).lstrip("+-").lower() in ("", "inf", "infinity"):
            return sign * 2 * ENDLESS
        return numbers(limit, key, 1, file)[0]

    def _joint_element(self, name: str, kind: str, parent: str, child: str) -> etree._Element:
        made = etree.Element("joint", name=name, type=kind)
        made.append(_origin(compose(inverse(self._link_frame(parent)), self._link_frame(child))))
        etree.SubElement(made, "parent", link=parent)
        etree.SubElement(made, "child", link=child)
        return made


def shape_of(part: etree._Element) -> etree._Element | None:
    """Returns the shape of a `<visual>` or `<collision>`."""
    geometry = part.find("geometry")
    shapes = [] if geometry is None else [child for child in geometry if isinstance(child.tag, str)]
    return shapes[0] if shapes else None


def turned(part: etree._Element, file: str) -> Pose:
    """Returns the turn of a shape in its part: that of a plane with a normal other than z."""
    shape = shape_of(part)
    if shape is None or shape.tag != "plane":
        return IDENTITY
    normal = numbers(shape, "normal", 3, file)
    length = math.hypot(*normal)
    if length == 0.0:
        raise SdfError("the <normal> of a plane is 0 0 0", file, line_of(shape))
    x, y, z = (value / length for value in normal)
    across = (-y, x, 0.0) if math.hypot(x, y) > 1e-9 else (1.0, 0.0, 0.0)
    return (0.0, 0.0, 0.0, *quaternion_about(across, math.atan2(math.hypot(x, y), z)))


def mass_of(inertial: etree._Element | None, file: str) -> float:
    """Returns the mass of a link; without an `<inertial>` it is that of the specification."""
    return NO_INERTIAL_MASS if inertial is None else max(numbers(inertial, "mass", 1, file)[0], 1e-4)


def _scale(shape: etree._Element) -> list[float]:
    return numbers(shape, "scale", 3, file_of(shape))


def _origin(pose: Pose) -> etree._Element:
    values = to_xyz_rpy(pose)
    return etree.Element("origin", xyz=_words(values[:3]), rpy=_words(values[3:]))


def _words(values: Sequence[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)


def _is_number(word: str) -> bool:
    try:
        return math.isfinite(float(word))
    except ValueError:
        return False
