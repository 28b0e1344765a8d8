"""Models of the sensors in `robot.yaml`. SI units; each sensor is at a link of the URDF."""

from __future__ import annotations

import math
from typing import Annotated, Final, Literal

from pydantic import Field, StringConstraints, model_validator

from executor.universes.strict import Strict

TURN: Final = 2 * math.pi

Topic = Annotated[str, StringConstraints(pattern=r"^/[A-Za-z0-9_/]+$", max_length=200)]
SensorName = Annotated[str, StringConstraints(pattern=r"^[A-Za-z][A-Za-z0-9_]*$", max_length=80)]
Positive = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e6, allow_inf_nan=False)]
Part = Annotated[float, Field(ge=0, le=1)]
Rate = Annotated[float, Field(gt=0, le=60, allow_inf_nan=False)]


class Lidar(Strict):
    """A counter-clockwise scanner.

    A full circle begins straight ahead, a smaller range of angles at its right end.

    Ranges outside of `range_min` to `range_max` are -inf and +inf (REP-117); `noise_m` is the standard
    deviation of a range.
    """

    name: SensorName = "scan"
    kind: Literal["lidar"]
    link: str
    topic: Topic = "/scan"
    rays: int = Field(default=360, ge=1, le=4000)
    fov: float = Field(default=TURN, gt=0.01, le=TURN + 1e-3)
    range_min: NotNegative = 0.12
    range_max: Positive = 8.0
    rate_hz: Rate = 10.0
    noise_m: NotNegative = 0.0

    @model_validator(mode="after")
    def _range_is_one(self) -> Lidar:
        if self.range_min >= self.range_max:
            raise ValueError("range_min must be less than range_max")
        return self

    @property
    def angle_min(self) -> float:
        """Direction of the first ray in rad, counter-clockwise from straight ahead."""
        return 0.0 if self.fov > TURN - 1e-2 else -self.fov / 2

    @property
    def angle_increment(self) -> float:
        """Angle from one ray to the next in rad."""
        if self.fov > TURN - 1e-2:
            return TURN / self.rays
        return self.fov / max(1, self.rays - 1)


class Camera(Strict):
    """A camera that looks along x of its link; `fov` is horizontal, in rad.

    With a `depth_topic` it measures depth too, through the same lens: 32FC1 in m along the optical axis,
    -inf nearer than `depth_min`, +inf beyond `depth_max` (REP-118).
    """

    name: SensorName = "camera"
    kind: Literal["camera"]
    link: str
    topic: Topic = "/camera/image_raw"
    info_topic: Topic = "/camera/camera_info"
    aliases: tuple[Topic, ...] = ()
    depth_topic: Topic | None = None
    depth_info_topic: Topic | None = None
    depth_min: NotNegative = 0.3
    depth_max: Positive = 8.0
    width: int = Field(default=640, ge=8, le=4096)
    height: int = Field(default=480, ge=8, le=4096)
    fov: float = Field(default=1.047, gt=0.05, lt=3.0)
    near: Positive = 0.05
    far: Positive = 60.0
    rate_hz: Rate = 15.0


class Imu(Strict):
    """Orientation, turning rate and acceleration at a link; the noises are standard deviations."""

    name: SensorName = "imu"
    kind: Literal["imu"]
    link: str
    topic: Topic = "/imu"
    rate_hz: Rate = 30.0
    rate_noise: NotNegative = 0.0
    acceleration_noise: NotNegative = 0.0


class Bumper(Strict):
    """Reports contacts of the robot's front half.

    `topic` is for any contact, its subtopics /left, /center and /right are for the zones.
    """

    name: SensorName = "bumper"
    kind: Literal["bumper"]
    link: str
    topic: Topic = "/bumper"
    rate_hz: Rate = 20.0


class Battery(Strict):
    """A battery. Currents in A: of the electronics, and of the motors at full speed.

    Wheels stop when it is empty.
    """

    name: SensorName = "battery"
    kind: Literal["battery"]
    topic: Topic = "/battery_state"
    rate_hz: Rate = 1.0
    voltage: Positive = 14.4
    capacity_ah: Positive = 4.4
    idle_a: NotNegative = 0.6
    drive_a: NotNegative = 1.8
    start: Part = 1.0


Sensor = Annotated[Lidar | Camera | Imu | Bumper | Battery, Field(discriminator="kind")]
