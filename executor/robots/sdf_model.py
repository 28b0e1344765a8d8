"""Makes a URDF from an SDF model: links with visual and collision shapes, and joints.

The frame of a URDF link is at its joint, while that of an SDF link can be anywhere. So every pose is first
computed in the frame of the model. The pose of the model itself is ignored, since the universe places the
model.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from lxml import etree

from executor.robots.urdf import UrdfError
from executor.universes.document import Problem
from executor.world.geometry.transforms import (
    IDENTITY,
    Pose,
    compose,
    from_xyz_rpy,
    inverse,
    rotate,
    to_xyz_rpy,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

MAX_BYTES: Final = 20_000_000
PLANE_THICKNESS_M: Final = 0.002
ENDLESS: Final = 1e6
"""Limits above this value mean "no limit"."""
_QUIET: Final = frozenset(
    {"pose", "static", "link", "joint", "frame", "self_collide", "allow_auto_disable", "enable_wind"}
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


def urdf_of_sdf(data: bytes, file: str = "model.sdf") -> Made:
    """Returns the URDF of the first model of an SDF document.

    Raises:
        UrdfError: the document is not an SDF with a model, or is invalid.
    """
    if len(data) > MAX_BYTES or b"<!DOCTYPE" in data:
        raise UrdfError("an SDF model has no DOCTYPE and is smaller than 20 MB", file)
    try:
        root = etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True))
    except etree.XMLSyntaxError as error:
        raise UrdfError(str(error.msg), file, error.lineno or 1) from error
    model = root.find("model") if root.tag == "sdf" else None
    if model is None:
        raise UrdfError("there is no <model> in an <sdf> element", file)
    return _Model(model, file).made()


class _Model:
    def __init__(self, model: etree._Element, file: str) -> None:
        self._model = model
        self._file = file
        self._left_out: list[Problem] = []
        self._links = self._named("link")
        self._joints = self._named("joint")
        self._frames = {**self._named("frame"), **self._joints, **self._links}
        self._known: dict[str, Pose] = {"__model__": IDENTITY, "": IDENTITY, "world": IDENTITY}
        if not self._links:
            raise self._wrong("a model needs a link", model)
        self._above = self._tree()

    def made(self) -> Made:
        """Returns the URDF of the whole model, and the parts that were left out."""
        robot = etree.Element("robot", name=self._model.get("name") or "model")
        for name, link in self._links.items():
            robot.append(self._link(name, link))
        first = next(name for name in self._links if name not in self._above)
        for name, link in self._links.items():
            joint = self._above.get(name)
            if joint is not None:
                robot.append(self._joint(name, joint))
            elif name != first:
                self._skip(link, f"no joint holds the link {name!r}: it is fastened to {first!r}")
                robot.append(self._joint_element(f"{name}_to_{first}", "fixed", first, name))
        for child in self._model:
            if isinstance(child.tag, str) and child.tag not in _QUIET:
                self._skip(child, f"<{child.tag}> of the model is not simulated")
        problems = sorted(self._left_out, key=lambda problem: problem.line)
        return Made(etree.tostring(robot, pretty_print=True), problems)

    # --- the tree ---

    def _named(self, tag: str) -> dict[str, etree._Element]:
        found: dict[str, etree._Element] = {}
        for element in self._model.findall(tag):
            name = element.get("name", "")
            if not name or name in found:
                text = f"the {tag} {name!r} is defined twice" if name else f"a {tag} needs a name"
                raise self._wrong(text, element)
            found[name] = element
        return found

    def _tree(self) -> dict[str, etree._Element]:
        """Returns the joint above each link, by link.

        Joints to the world, and those that would close a loop, are left out.
        """
        above: dict[str, etree._Element] = {}
        for name, joint in self._joints.items():
            parent, child = _text(joint, "parent"), _text(joint, "child")
            if parent == "world":  # Bullet fixes a root without mass
                continue
            for link in (parent, child):
                if link not in self._links:
                    raise self._wrong(
                        f"the joint {name!r} names the link {link!r}, which does not exist", joint
                    )
            if child in above or child in self._ancestors(parent, above):
                self._skip(joint, f"the joint {name!r} closes a loop")
                continue
            above[child] = joint
        return above

    def _ancestors(self, link: str, above: dict[str, etree._Element]) -> Iterator[str]:
        yield link
        while link in above:
            link = _text(above[link], "parent")
            yield link

    # --- poses ---

    def _in_model(self, name: str, asked: tuple[str, ...] = ()) -> Pose:
        """Returns the pose of a link, a joint or a frame in the model's frame."""
        if name not in self._known:
            element = self._frames.get(name)
            if element is None or name in asked:
                place = self._frames[asked[-1]] if asked else self._model
                why = "goes round in a circle" if element is not None else "does not exist"
                raise self._wrong(f"the frame {name!r} {why}", place)
            default = {"joint": _text(element, "child"), "frame": element.get("attached_to", "")}
            base = default.get(str(element.tag), "__model__")
            self._known[name] = self._pose(element, base, (*asked, name))
        return self._known[name]

    def _pose(self, element: etree._Element, base: str, asked: tuple[str, ...] = ()) -> Pose:
        """Returns the pose of an element in the model's frame.

        Its values are relative to `base` unless it names another frame.
        """
        pose = element.find("pose")
        if pose is not None:
            base = pose.get("relative_to") or base
        text = "" if pose is None else (pose.text or "").strip()
        own = from_xyz_rpy(self._numbers(element, "pose", 6)) if text else IDENTITY
        return compose(self._in_model(base, asked), own)

    def _link_frame(self, link: str) -> Pose:
        """Returns a link's frame in the URDF: at its joint, or at the model's origin if it has no joint."""
        joint = self._above.get(link)
        return IDENTITY if joint is None else self._in_model(joint.get("name", ""))

    # --- elements ---

    def _link(self, name: str, link: etree._Element) -> etree._Element:
        made = etree.Element("link", name=name)
        frame = inverse(self._link_frame(name))
        inertial = link.find("inertial")
        if inertial is not None:
            made.append(self._inertial(inertial, compose(frame, self._pose(inertial, name))))
        for tag in ("visual", "collision"):
            for part in link.findall(tag):
                geometry = self._geometry(part)
                if geometry is None:
                    continue
                element = etree.SubElement(made, tag)
                element.append(_origin(compose(frame, self._pose(part, name))))
                element.append(geometry)
                if tag == "visual":
                    element.append(self._material(part))
        for other in ("sensor", "light", "particle_emitter", "projector"):
            for found in link.findall(other):
                self._skip(found, f"<{other}> of the link {name!r} is not simulated")
        return made

    def _inertial(self, inertial: etree._Element, pose: Pose) -> etree._Element:
        made = etree.Element("inertial")
        made.append(_origin(pose))
        mass = self._numbers(inertial, "mass", 1)[0] if inertial.find("mass") is not None else 1.0
        etree.SubElement(made, "mass", value=f"{max(mass, 1e-4):.9g}")
        inertia = inertial.find("inertia")
        # The default is a ball of 1 kg with a radius of 6 cm.
        values = {"ixx": mass * 1.5e-3, "iyy": mass * 1.5e-3, "izz": mass * 1.5e-3}
        if inertia is not None:
            values |= {str(v.tag): self._numbers(inertia, str(v.tag), 1)[0] for v in inertia if len(v) == 0}
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        etree.SubElement(made, "inertia", {name: f"{values.get(name, 0.0):.9g}" for name in names})
        return made

    def _geometry(self, part: etree._Element) -> etree._Element | None:
        geometry = part.find("geometry")
        shape = geometry[0] if geometry is not None and len(geometry) else None
        if shape is None:
            return None
        made = etree.Element("geometry")
        match shape.tag:
            case "box":
                etree.SubElement(made, "box", size=_words(self._numbers(shape, "size", 3)))
            case "plane":
                size = self._numbers(shape, "size", 2) if shape.find("size") is not None else [1.0, 1.0]
                etree.SubElement(made, "box", size=_words([*size, PLANE_THICKNESS_M]))
            case "sphere":
                etree.SubElement(made, "sphere", radius=_words(self._numbers(shape, "radius", 1)))
            case "cylinder" | "capsule":
                keys = {key: _words(self._numbers(shape, key, 1)) for key in ("radius", "length")}
                etree.SubElement(made, str(shape.tag), keys)
            case "mesh":
                scale = self._numbers(shape, "scale", 3) if shape.find("scale") is not None else [1.0] * 3
                uri = _text(shape, "uri").replace("model://", "package://", 1)
                etree.SubElement(made, "mesh", filename=uri, scale=_words(scale))
            case _:
                self._skip(shape, f"<{shape.tag}> is no shape that we have")
                return None
        return made

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

    def _joint(self, child: str, joint: etree._Element) -> etree._Element:
        name, kind = joint.get("name", ""), joint.get("type", "")
        if kind not in _KINDS:
            self._skip(joint, f"the joint {name!r} is {kind or 'of no type'}: it is fixed here")
            kind = "fixed"
        made = self._joint_element(name, kind, _text(joint, "parent"), child)
        axis = joint.find("axis")
        if kind == "fixed" or axis is None:
            made.set("type", "fixed")
            return made
        etree.SubElement(made, "axis", xyz=_words(self._axis(joint, axis)))
        limit = axis.find("limit")
        ends = [self._limit(limit, key, sign) for key, sign in (("lower", -1), ("upper", 1))]
        if max(map(abs, ends)) >= ENDLESS and kind == "revolute":
            made.set("type", "continuous")
        else:
            low, high = f"{ends[0]:.9g}", f"{ends[1]:.9g}"
            etree.SubElement(made, "limit", lower=low, upper=high, effort="1000", velocity="100")
        if axis.find("dynamics") is not None:
            self._dynamics(made, axis.find("dynamics"))
        return made

    def _dynamics(self, made: etree._Element, dynamics: etree._Element | None) -> None:
        if dynamics is not None:
            keys = [key for key in ("damping", "friction") if dynamics.find(key) is not None]
            values = {key: _words(self._numbers(dynamics, key, 1)) for key in keys}
            etree.SubElement(made, "dynamics", values)

    def _axis(self, joint: etree._Element, axis: etree._Element) -> Sequence[float]:
        """Returns the axis of a joint in the joint's frame."""
        xyz = axis.find("xyz")
        if xyz is None:
            return (0.0, 0.0, 1.0)
        values = self._numbers(axis, "xyz", 3)
        if not any(values):
            raise self._wrong("an axis needs a direction", xyz)
        said = xyz.get("expressed_in")
        if not said and _text(axis, "use_parent_model_frame") in ("1", "true"):
            said = "__model__"
        if said:
            turn = compose(inverse(self._in_model(joint.get("name", ""))), self._in_model(said))
            return rotate(turn[3:], values)
        return values

    def _limit(self, limit: etree._Element | None, key: str, sign: int) -> float:
        if limit is None or limit.find(key) is None:
            return sign * 2 * ENDLESS
        text = _text(limit, key)
        if text.lstrip("+-").lower() in ("inf", "infinity"):
            return sign * 2 * ENDLESS
        return self._numbers(limit, key, 1)[0]

    def _joint_element(self, name: str, kind: str, parent: str, child: str) -> etree._Element:
        made = etree.Element("joint", name=name, type=kind)
        made.append(_origin(compose(inverse(self._link_frame(parent)), self._link_frame(child))))
        etree.SubElement(made, "parent", link=parent)
        etree.SubElement(made, "child", link=child)
        return made

    # --- what is wrong, and what is left out ---

    def _numbers(self, element: etree._Element, tag: str, count: int) -> list[float]:
        text = _text(element, tag)
        values = [float(word) for word in text.split() if _is_number(word)]
        if len(values) != count or len(text.split()) != count:
            found = element.find(tag)
            what = f"<{tag}> needs {count} number{'s' if count > 1 else ''}, not {text!r}"
            raise self._wrong(what, element if found is None else found)
        return values

    def _wrong(self, message: str, element: etree._Element) -> UrdfError:
        return UrdfError(message, self._file, int(str(element.sourceline)))

    def _skip(self, element: etree._Element, message: str) -> None:
        self._left_out.append(Problem(message, int(str(element.sourceline)), code="BTU006"))


def _origin(pose: Pose) -> etree._Element:
    values = to_xyz_rpy(pose)
    return etree.Element("origin", xyz=_words(values[:3]), rpy=_words(values[3:]))


def _words(values: Sequence[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)


def _text(element: etree._Element, tag: str) -> str:
    return (element.findtext(tag) or "").strip()


def _is_number(word: str) -> bool:
    try:
        return math.isfinite(float(word))
    except ValueError:
        return False
