"""The model of a robot's `robot.yaml`: its URDF, its drive, its sensors."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from pydantic import Field

from executor.robots.links import read_links
from executor.robots.sensors import (
    Battery,
    Bumper,
    Camera,
    Imu,
    Lidar,
    NotNegative,
    Part,
    Positive,
    Sensor,
    Topic,
)
from executor.robots.urdf import MOVING
from executor.universes.document import DocumentError, Located, Problem, read_yaml, text_of
from executor.universes.loader import validate
from executor.universes.strict import Strict
from tree_gardener.packages import Place

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from executor.messages import Mesh
    from executor.robots.urdf import Urdf

__all__ = [
    "Battery",
    "Bumper",
    "Camera",
    "CommandType",
    "Drive",
    "Imu",
    "JointDrive",
    "Lidar",
    "RobotConfig",
    "RobotError",
    "load_robot",
    "preview_path",
    "robot_ids",
]

_FOLDER: Final = Path(__file__).parent

CommandType = Literal["twist", "twist_stamped", "both"]


class RobotError(DocumentError):
    """A robot cannot be used; `problems` hold the reasons and their places."""


class Drive(Strict):
    """A differential drive. Speeds in m/s and rad/s, accelerations in m/s² and rad/s².

    `turn_factor` is the ratio of the effective track width in turns to `track`: 1 with one wheel on each
    side, more if wheels must skid. `slip_noise` is the standard deviation in m of the distance that odometry
    measures for a wheel after 1 m; it grows with the square root of the distance.
    """

    kind: Literal["differential"] = "differential"
    left: tuple[str, ...] = Field(min_length=1)
    right: tuple[str, ...] = Field(min_length=1)
    wheel_radius: Positive
    track: Positive
    max_linear: Positive
    max_angular: Positive
    linear_acceleration: Positive = 1.5
    angular_acceleration: Positive = 6.0
    wheel_torque: Positive = 2.0
    turn_factor: Positive = 1.0
    slip_noise: NotNegative = 0.0
    timeout_s: Positive = 0.6


class JointDrive(Strict):
    """A motor that holds a joint at the last position received on `topic` (`std_msgs/Float64`).

    Positions are in rad, or in m for a prismatic joint, and are kept within the limits of the URDF;
    `max_rate` is in rad/s or m/s, `torque` in Nm or N.
    """

    joint: str
    topic: Topic
    max_rate: Positive = 1.0
    torque: Positive = 2.0
    start: float = Field(default=0.0, allow_inf_nan=False)


class RobotDocument(Strict):
    """A `robot.yaml`, before its names are looked up in the URDF.

    `command_type` is the message type of `/cmd_vel`: `geometry_msgs/Twist`, `geometry_msgs/TwistStamped` as
    for robots of ROS 2 Jazzy, or both. With `ground_truth` the robot publishes its true pose on
    `/ground_truth/odom`. `arguments` are values for the arguments of an xacro file, as text.
    """

    format: Literal["bt-studio/robot"]
    version: Literal[1]
    name: str
    description: str = ""
    urdf: str
    arguments: dict[str, str] = Field(default_factory=dict)
    drive: Drive
    command_type: CommandType = "both"
    ground_truth: bool = False
    joints: tuple[JointDrive, ...] = Field(default=(), max_length=20)
    wheels: tuple[str, ...] = ()
    friction: dict[str, NotNegative] = Field(default_factory=dict)
    skid: dict[str, Part] = Field(default_factory=dict)
    sensors: tuple[Sensor, ...] = ()


@dataclass(frozen=True)
class RobotConfig:
    """A robot, read and checked.

    Args:
        wheels: links whose contacts do not count as collisions: wheels and casters.
        friction: friction by link, of `robot.yaml` or else of the URDF; 0.8 for links without an entry.
        joints: the joints with a motor, other than those of wheels.
        command_type: the message type of `/cmd_vel`.
        ground_truth: whether the robot publishes its true pose.
        skid: factor of the friction along a wheel's axis by link, 0 to 1, for wheels that slide sideways when
            the robot turns; along y for other links.
    """

    id: str
    name: str
    urdf_path: Path
    urdf: Urdf
    meshes: dict[str, Mesh]
    drive: Drive
    wheels: tuple[str, ...]
    friction: dict[str, float]
    skid: dict[str, float]
    lidars: tuple[Lidar, ...]
    cameras: tuple[Camera, ...]
    imus: tuple[Imu, ...] = ()
    bumpers: tuple[Bumper, ...] = ()
    batteries: tuple[Battery, ...] = ()
    joints: tuple[JointDrive, ...] = ()
    command_type: CommandType = "both"
    ground_truth: bool = False


def robot_ids() -> tuple[str, ...]:
    """Returns the ids of the built-in robots."""
    return tuple(sorted(path.parent.name for path in _FOLDER.glob("*/robot.yaml")))


def preview_path(robot_id: str) -> Path:
    """Returns the path of the picture of a built-in robot; `executor.generate.previews` draws it."""
    return _FOLDER / robot_id / "preview.webp"


def load_robot(robot_id: str, assets: Path | None = None) -> RobotConfig:
    """Returns a robot by its id: one of the project (`robots/<id>/` in `assets`), or a built-in one.

    Raises:
        RobotError: it does not exist or is wrong.
    """
    folders = {robot_id: _FOLDER / robot_id}
    if assets is not None:
        own = f"robots/{robot_id}"
        folders = {own: assets / own, **folders}
    for shown, folder in folders.items():
        if (folder / "robot.yaml").is_file():
            return _read(robot_id, folder, shown, assets)
    near = difflib.get_close_matches(robot_id, robot_ids(), n=1)
    hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(robot_ids())}"
    raise RobotError([Problem(f"there is no robot {robot_id!r}", code="BTR001", hint=hint)], robot_id)


def _read(robot_id: str, folder: Path, shown: str, assets: Path | None) -> RobotConfig:
    """Reads a robot; `shown` is the name of its folder in errors, a path of the project."""
    file = folder / "robot.yaml"
    try:
        located = read_yaml(text_of(file.read_bytes(), file.name), file.name)
        document = validate(located, RobotDocument, file.name)
    except DocumentError as error:
        raise RobotError(error.problems, f"{shown}/{file.name}") from error
    urdf_path = folder / document.urdf
    places = [Place(shown, folder)] + ([] if assets is None else [Place("the project", assets)])
    urdf, meshes = _read_urdf(urdf_path, f"{shown}/{document.urdf}", places, document.arguments)
    _check_names(f"{shown}/{file.name}", located, document, urdf)
    urdf = replace(urdf, notes=(*urdf.notes, *_stiff_wheels(document.drive, urdf, located)))
    return RobotConfig(
        id=robot_id,
        name=document.name,
        urdf_path=urdf_path,
        urdf=urdf,
        meshes=meshes,
        drive=document.drive,
        joints=document.joints,
        command_type=document.command_type,
        ground_truth=document.ground_truth,
        wheels=document.wheels,
        friction=urdf.friction | document.friction,
        skid=document.skid,
        lidars=tuple(sensor for sensor in document.sensors if isinstance(sensor, Lidar)),
        cameras=tuple(sensor for sensor in document.sensors if isinstance(sensor, Camera)),
        imus=tuple(sensor for sensor in document.sensors if isinstance(sensor, Imu)),
        bumpers=tuple(sensor for sensor in document.sensors if isinstance(sensor, Bumper)),
        batteries=tuple(sensor for sensor in document.sensors if isinstance(sensor, Battery)),
    )


def _read_urdf(
    path: Path, shown: str, places: Sequence[Place], arguments: Mapping[str, str]
) -> tuple[Urdf, dict[str, Mesh]]:
    try:
        return read_links(path, shown, places, arguments)
    except DocumentError as error:
        raise RobotError(error.problems, error.file) from error


def _check_names(shown: str, located: Located, document: RobotDocument, urdf: Urdf) -> None:
    """Checks that the URDF has all links and joints that the document names."""
    drive = document.drive
    links: list[tuple[tuple[str | int, ...], str]] = [
        *((("wheels", i), name) for i, name in enumerate(document.wheels)),
        *((("friction", name), name) for name in document.friction),
        *((("skid", name), name) for name in document.skid),
        *(
            (("sensors", i, "link"), sensor.link)
            for i, sensor in enumerate(document.sensors)
            if not isinstance(sensor, Battery)
        ),
    ]
    joints: list[tuple[tuple[str | int, ...], str]] = [
        *((("drive", "left", i), name) for i, name in enumerate(drive.left)),
        *((("drive", "right", i), name) for i, name in enumerate(drive.right)),
        *((("joints", i, "joint"), joint.joint) for i, joint in enumerate(document.joints)),
    ]
    problems = _missing("link", links, urdf.links, located) + _missing("joint", joints, urdf.joints, located)
    wheels = (*drive.left, *drive.right)
    for i, driven in enumerate(document.joints):
        joint = urdf.joints.get(driven.joint)
        if joint is not None and (joint.kind not in MOVING or driven.joint in wheels):
            why = "drives a wheel" if driven.joint in wheels else f"is {joint.kind}"
            text = f"the joint {driven.joint!r} {why}, so it cannot be listed under `joints`"
            problems.append(Problem(text, *located.place(("joints", i, "joint")), "BTR003"))
    if problems:
        raise RobotError(problems, shown)


def _stiff_wheels(drive: Drive, urdf: Urdf, located: Located) -> list[Problem]:
    """Returns a note for each wheel that its motor cannot turn."""
    notes = []
    for side in ("left", "right"):
        for i, name in enumerate(getattr(drive, side)):
            friction = urdf.joints[name].friction
            if friction >= drive.wheel_torque:
                torque = f"a motor with a wheel_torque of {drive.wheel_torque:g} Nm cannot turn it"
                text = f"the friction of the joint {name!r} is {friction:g} Nm, so {torque}"
                notes.append(Problem(text, *located.place(("drive", side, i)), "BTR005"))
    return notes


def _missing(
    what: str,
    names: list[tuple[tuple[str | int, ...], str]],
    known: Collection[str],
    located: Located,
) -> list[Problem]:
    problems = []
    for path, name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(sorted(known))}"
            problems.append(Problem(f"the URDF has no {what} {name!r}", *located.place(path), "BTR003", hint))
    return problems
