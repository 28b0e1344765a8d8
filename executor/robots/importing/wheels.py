"""Finds the drive of a robot: the wheels that turn it, their radius and track, and the castors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.robots.boxes import extent_of_links
from executor.world.geometry.kinematics import link_pose
from executor.world.geometry.transforms import IDENTITY, compose, rotate, rotation

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from lxml import etree

    from executor.messages import Mesh
    from executor.robots.importing.report import Report
    from executor.robots.urdf import Joint, Urdf

ALONG: Final = 0.9
"""Least cosine between an axis and the direction that it is taken for."""
SLOWEST, FASTEST = 0.05, 20.0
"""Highest speeds in m/s that a robot plausibly has."""
TOUCH_M: Final = 0.006
"""A part this far above the floor or less is taken for one that stands on it."""
_PLUGINS: Final = ("diff_drive", "diff-drive", "diffdrive", "skid_steer", "skid-steer")
_STEERED: Final = ("ackermann", "ackermann_drive", "tricycle_drive")
_LEFT: Final = ("left_joint", "left_wheel_joint", "leftJoint", "leftFrontJoint", "leftRearJoint")
_RIGHT: Final = ("right_joint", "right_wheel_joint", "rightJoint", "rightFrontJoint", "rightRearJoint")


class NoDriveError(Exception):
    """The robot has no drive that we have; the text says why."""


@dataclass(frozen=True)
class Base:
    """The drive of a robot. Lengths in m, speeds in m/s and rad/s.

    Args:
        left: the joints of the wheels on the left, from front to back; `right` as well.
        castors: links other than driven wheels that stand on the floor.
        sliding: castors that neither turn nor have a friction.
    """

    left: tuple[str, ...]
    right: tuple[str, ...]
    radius: float
    track: float
    max_linear: float
    max_angular: float
    torque: float
    castors: tuple[str, ...]
    sliding: tuple[str, ...]

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints of all driven wheels."""
        return (*self.left, *self.right)


def find_base(urdf: Urdf, root: etree._Element, meshes: Mapping[str, Mesh], report: Report) -> Base:
    """Returns the drive of a robot.

    Args:
        urdf: the links.
        root: the document, whose plugins of Gazebo may name the wheels.
        meshes: the meshes by their names in the URDF.
        report: takes what was read and assumed.

    Raises:
        NoDriveError: it has none, or one that cannot be simulated.
    """
    plugin = _plugin(root)
    _refuse_steering(urdf, root)
    left, right, source = _sides(urdf, plugin)
    wheels = [urdf.joints[name] for name in (*left, *right)]
    places = {joint.name: link_pose(urdf, IDENTITY, joint.child, {}) for joint in wheels}
    extents = extent_of_links(urdf, meshes)
    radii = [radius for joint in wheels if (radius := _radius(joint, extents)) is not None]
    said = _said(plugin, ("wheel_radius", "wheelRadius"), ("wheel_diameter", "wheelDiameter"))
    if not radii and said is None:
        raise NoDriveError("the wheels have no shape, so their radius is not known")
    radius = float(np.median(radii)) if radii else said or 0.0
    if radii and said is not None and abs(said - radius) > 0.02 * radius:
        report.assumed.append(
            f"the wheels' radius is that of their shape, {radius:.4g} m; the plugin says {said:.4g} m"
        )
    track = float(np.mean([places[n][1] for n in left]) - np.mean([places[n][1] for n in right]))
    report.taken.append(
        f"the drive: {', '.join(left)} on the left and {', '.join(right)} on the right ({source}), "
        f"radius {radius:.4g} m, track {track:.4g} m"
    )
    floor = min(places[joint.name][2] for joint in wheels) - radius
    castors, sliding = _castors(urdf, {joint.child for joint in wheels}, extents, floor)
    for link in sliding:
        report.assumed.append(
            f"the link {link!r} stands on the floor and does not turn: it slides without friction"
        )
    linear, angular = _speeds(root, wheels, plugin, radius, track, report)
    torque = _torque(urdf, root, wheels, plugin, radius, report)
    return Base(left, right, radius, track, linear, angular, torque, castors, sliding)


def _plugin(root: etree._Element) -> etree._Element | None:
    for plugin in root.iter("plugin"):
        words = f"{plugin.get('filename', '')} {plugin.get('name', '')}".lower()
        if any(word in words for word in _PLUGINS):
            return plugin
    return None


def _refuse_steering(urdf: Urdf, root: etree._Element) -> None:
    for plugin in root.iter("plugin"):
        words = f"{plugin.get('filename', '')} {plugin.get('name', '')}".lower()
        if any(word in words for word in _STEERED):
            raise NoDriveError(
                "its plugin steers wheels (Ackermann), and only differential drives are simulated"
            )
    steered = [
        joint.name
        for joint in urdf.joints.values()
        if joint.kind == "continuous"
        and (above := urdf.joint_above.get(joint.parent)) is not None
        and above.kind == "revolute"
        and abs(_axis(urdf, above)[2]) > ALONG
        and abs(_axis(urdf, joint)[1]) > ALONG
    ]
    if len(steered) >= 2:
        names = ", ".join(steered)
        raise NoDriveError(
            f"the wheels {names} are steered (Ackermann), and only differential drives are simulated"
        )


def _sides(urdf: Urdf, plugin: etree._Element | None) -> tuple[tuple[str, ...], tuple[str, ...], str]:
    if plugin is not None:
        left, right = (_named(plugin, tags) for tags in (_LEFT, _RIGHT))
        known = [name for name in (*left, *right) if name in urdf.joints]
        if left and right and len(known) == len(left) + len(right):
            return left, right, "named by the plugin of Gazebo"
    found = [joint for joint in urdf.joints.values() if _is_wheel(urdf, joint)]
    at = {joint.name: link_pose(urdf, IDENTITY, joint.child, {}) for joint in found}
    found.sort(key=lambda joint: -at[joint.name][0])
    left = tuple(joint.name for joint in found if at[joint.name][1] > 1e-3)
    right = tuple(joint.name for joint in found if at[joint.name][1] < -1e-3)
    if not left or not right:
        count = len(found)
        what = f"{count} wheel{'' if count == 1 else 's'}" if count else "no wheel"
        raise NoDriveError(
            f"it has {what}: a drive needs a continuous joint along y on each side of the robot"
        )
    return left, right, "continuous joints along y"


def _named(plugin: etree._Element, tags: Iterable[str]) -> tuple[str, ...]:
    names = [(e.text or "").strip().rsplit("/", 1)[-1] for tag in tags for e in plugin.iter(tag)]
    return tuple(dict.fromkeys(name for name in names if name))


def _is_wheel(urdf: Urdf, joint: Joint) -> bool:
    """Returns whether a joint turns about y and does not hang on one that turns about z, as a castor's.

    It may hang on a suspension.
    """
    if joint.kind != "continuous" or joint.mimic is not None or abs(_axis(urdf, joint)[1]) < ALONG:
        return False
    above = urdf.joint_above.get(joint.parent)
    while above is not None:
        if above.kind in ("continuous", "revolute") and abs(_axis(urdf, above)[2]) > ALONG:
            return False
        above = urdf.joint_above.get(above.parent)
    return True


def _axis(urdf: Urdf, joint: Joint) -> tuple[float, float, float]:
    """Returns the axis of a joint in the frame of the root, with all joints at zero."""
    pose = compose(link_pose(urdf, IDENTITY, joint.parent, {}), joint.origin)
    x, y, z = rotate(pose[3:], joint.axis)
    return (x, y, z)


Extents = dict[str, tuple[np.ndarray, np.ndarray]]


def _radius(joint: Joint, extents: Extents) -> float | None:
    if joint.child not in extents:
        return None
    low, high = extents[joint.child]
    across = [abs(float(bound)) for i in range(3) if abs(joint.axis[i]) < 0.5 for bound in (low[i], high[i])]
    return max(across) if across else None


def _said(plugin: etree._Element | None, tags: Iterable[str], doubled: Iterable[str] = ()) -> float | None:
    if plugin is None:
        return None
    for tag, factor in (*((tag, 1.0) for tag in tags), *((tag, 0.5) for tag in doubled)):
        text = plugin.findtext(tag)
        try:
            if text is not None and 0 < (value := float(text)) < 1e3:
                return value * factor
        except ValueError:
            continue
    return None


def _speeds(  # noqa: PLR0913, PLR0917 - a drive, and where its speeds may stand
    root: etree._Element,
    wheels: list[Joint],
    plugin: etree._Element | None,
    radius: float,
    track: float,
    report: Report,
) -> tuple[float, float]:
    linear = _said(plugin, ("max_linear_velocity", "max_velocity"))
    angular = _said(plugin, ("max_angular_velocity",))
    names = {joint.name for joint in wheels}
    limits = [
        float(limit.get("velocity", "0"))
        for joint in root.iterfind("joint")
        if joint.get("name") in names and (limit := joint.find("limit")) is not None
    ]
    rates = [rate for rate in limits if 0 < rate < 1e3]
    if linear is None and rates and SLOWEST <= min(rates) * radius <= FASTEST:
        linear = min(rates) * radius
        report.taken.append(f"the highest speed: {linear:.3g} m/s, by the velocity limit of the wheels")
    elif linear is None and rates:
        would_be = f"{min(rates):g} rad/s, would be {min(rates) * radius:.3g} m/s"
        report.assumed.append(f"the velocity limit of the wheels, {would_be}: it is not taken")
    if linear is None:
        linear = 0.5
        report.assumed.append("the highest speed is 0.5 m/s")
    if angular is None:
        angular = min(2.0 * linear / track, 3.0)
        report.assumed.append(f"the highest turning rate is {angular:.3g} rad/s")
    return linear, angular


def _torque(  # noqa: PLR0913, PLR0917 - as above
    urdf: Urdf,
    root: etree._Element,
    wheels: list[Joint],
    plugin: etree._Element | None,
    radius: float,
    report: Report,
) -> float:
    mass = sum(float(each.get("value", "0")) for each in root.iterfind("link/inertial/mass"))
    needed = 4.0 * mass * 1.5 * radius / len(wheels)  # four times what 1.5 m/s² takes
    needed += max(joint.friction for joint in wheels)
    found = [joint.effort for joint in wheels if joint.effort]
    said = _said(plugin, ("max_wheel_torque", "wheelTorque", "torque")) or (min(found) if found else None)
    if said is not None and needed / 4 <= said:
        report.taken.append(f"the torque of a wheel: {said:.3g} Nm")
        return said
    torque = max(2.0, needed)
    why = "" if said is None else f"; {said:.3g} Nm in the file cannot move {mass:.3g} kg"
    report.assumed.append(f"the torque of a wheel is {torque:.3g} Nm{why}")
    return torque


def _castors(
    urdf: Urdf, driven: set[str], extents: Extents, floor: float
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    castors, sliding = [], []
    for name in urdf.links:
        if name in driven or name not in extents or name == urdf.root:
            continue
        low, high = extents[name]
        pose = link_pose(urdf, IDENTITY, name, {})
        corners = np.array(
            [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
        )
        bottom = float((corners @ rotation(pose[3:]).T + np.array(pose[:3]))[:, 2].min())
        if not math.isfinite(bottom) or bottom > floor + TOUCH_M:
            continue
        castors.append(name)
        _, carrier = name, urdf.joint_above.get(name)
        is_round = carrier is not None and carrier.kind == "continuous"
        if not is_round and name not in urdf.friction:
            sliding.append(name)
    return tuple(castors), tuple(sliding)
