"""Values of SDF elements, with the defaults of the specification."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from executor.sdf.dialect import SdfError, line_of
from executor.world.geometry.transforms import IDENTITY, Pose, from_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lxml import etree

DEFAULTS: Final[dict[tuple[str, str], tuple[float, ...]]] = {
    ("box", "size"): (1.0, 1.0, 1.0),
    ("sphere", "radius"): (1.0,),
    ("cylinder", "radius"): (1.0,),
    ("cylinder", "length"): (1.0,),
    ("capsule", "radius"): (0.5,),
    ("capsule", "length"): (1.0,),
    ("ellipsoid", "radii"): (1.0, 1.0, 1.0),
    ("cone", "radius"): (0.5,),
    ("cone", "length"): (1.0,),
    ("plane", "normal"): (0.0, 0.0, 1.0),
    ("plane", "size"): (1.0, 1.0),
    ("mesh", "scale"): (1.0, 1.0, 1.0),
    ("heightmap", "size"): (1.0, 1.0, 1.0),
    ("heightmap", "pos"): (0.0, 0.0, 0.0),
    ("light", "direction"): (0.0, 0.0, -1.0),
    ("light", "intensity"): (1.0,),
    ("inertial", "mass"): (1.0,),
    ("axis", "xyz"): (0.0, 0.0, 1.0),
    ("waypoint", "time"): (0.0,),
    ("mimic", "multiplier"): (1.0,),
    ("mimic", "offset"): (0.0,),
    ("mimic", "reference"): (0.0,),
    ("world", "gravity"): (0.0, 0.0, -9.8),
}
"""By element and child, from the specification (`sdf/1.12`); a test compares them with `sdformat-sdf`."""
NO_INERTIAL_MASS: Final = 1.0
NO_INERTIA: Final = {"ixx": 1.0, "ixy": 0.0, "ixz": 0.0, "iyy": 1.0, "iyz": 0.0, "izz": 1.0}


def text_of(element: etree._Element, tag: str) -> str:
    """Returns the text of a child, without blanks around it; "" if there is none."""
    return (element.findtext(tag) or "").strip()


def is_true(element: etree._Element, tag: str, *, default: bool = False) -> bool:
    """Returns a truth value as Gazebo reads it: `true` in any case, or 1."""
    text = text_of(element, tag).lower()
    return text in ("true", "1") if text else default


def numbers(element: etree._Element, tag: str, count: int, file: str) -> list[float]:
    """Returns the numbers of a child; where it is missing or empty, the default of the specification.

    Raises:
        SdfError: it has another number of them, or text that is no number, or it must be there.
    """
    text = text_of(element, tag)
    default = DEFAULTS.get((str(element.tag), tag))
    if not text and default is not None:
        return list(default)
    found = element.find(tag)
    return _numbers(text, count, tag, element if found is None else found, file)


def pose_in(pose: etree._Element | None, file: str) -> Pose:
    """Returns the values of a `<pose>` in the frame that it names.

    Raises:
        SdfError: it is malformed.
    """
    text = "" if pose is None else (pose.text or "").strip()
    if pose is None or not text:
        return IDENTITY
    form = pose.get("rotation_format", "euler_rpy")
    if form == "quat_xyzw":
        values = _numbers(text, 7, "pose", pose, file)
        length = math.hypot(*values[3:])
        if length < 1e-9:
            raise SdfError("the quaternion of a <pose> is 0 0 0 0", file, line_of(pose))
        x, y, z, w = (value / length for value in values[3:])
        return (values[0], values[1], values[2], x, y, z, w)
    if form != "euler_rpy":
        raise SdfError(
            f"the rotation_format of a <pose> is euler_rpy or quat_xyzw, not {form!r}", file, line_of(pose)
        )
    values = _numbers(text, 6, "pose", pose, file)
    if pose.get("degrees", "").strip().lower() in ("true", "1"):
        values = [*values[:3], *map(math.radians, values[3:])]
    return from_xyz_rpy(values)


def _numbers(text: str, count: int, tag: str, place: etree._Element, file: str) -> list[float]:
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        what = f"<{tag}> needs {count} number{'s' if count > 1 else ''}, not {text!r}"
        raise SdfError(what, file, line_of(place))
    return values


def rounded(values: Sequence[float]) -> list[float]:
    """Returns numbers with a micrometre's digits."""
    return [round(float(value), 6) + 0.0 for value in values]
