"""The motors of a robot's joints other than wheels: each holds its last target position."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.robots.config import JointDrive, RobotConfig
    from executor.world.engine import Bullet

GAIN: Final = 0.3
"""Share of a position error that a motor corrects in one physics step."""


class RobotJoints:
    """Some joints of a robot.

    Args:
        bullet: the physics server.
        uid: the id of the robot in the physics server.
        config: the configuration of the robot.
        indices: the indices of these joints in the physics server, by name.
    """

    def __init__(self, bullet: Bullet, uid: int, config: RobotConfig, indices: Mapping[str, int]) -> None:
        self._bullet = bullet
        self._uid = uid
        self._joints = config.urdf.joints
        self._indices = indices

    def __bool__(self) -> bool:
        return bool(self._indices)

    def states(self) -> dict[str, tuple[float, float]]:
        """Returns the position and the rate of each joint."""
        return self._states(self._indices)

    def _states(self, indices: Mapping[str, int]) -> dict[str, tuple[float, float]]:
        if not indices:
            return {}
        states = self._bullet.getJointStates(self._uid, list(indices.values()))
        return {name: (state[0], state[1]) for name, state in zip(indices, states, strict=True)}

    def _within(self, joint: str, position: float) -> float:
        limits = self._joints[joint].limits
        return position if limits is None else max(limits[0], min(limits[1], position))


class JointMotors(RobotJoints):
    """Moves joints to their targets within their rate limits.

    Args:
        bullet: the physics server.
        uid: the id of the robot in the physics server.
        config: the configuration of the robot.
        indices: the indices of the joints in the physics server, by name.
    """

    def __init__(self, bullet: Bullet, uid: int, config: RobotConfig, indices: Mapping[str, int]) -> None:
        self._drives = {drive.joint: drive for drive in config.joints}
        super().__init__(bullet, uid, config, {name: indices[name] for name in self._drives})
        self._wanted = {name: self._within(name, drive.start) for name, drive in self._drives.items()}
        self._held: dict[str, float] = {}
        self.control()

    def command(self, joint: str, position: float) -> bool:
        """Sets the target of a joint in rad or m, within its limits; returns False if it is not finite."""
        if not math.isfinite(position):
            return False
        self._wanted[joint] = self._within(joint, position)
        return True

    def control(self) -> None:
        """Sets the motors' current targets; called once in each control period while the robot has power."""
        for name, wanted in self._wanted.items():
            if self._held.get(name) != wanted:
                self._hold(self._drives[name], wanted)

    def save(self) -> dict[str, dict[str, float]]:
        """Returns the state that the physics server does not save itself, as plain data."""
        return {"wanted": dict(self._wanted), "held": dict(self._held)}

    def restore(self, saved: Mapping[str, Mapping[str, float]]) -> None:
        """Restores a state that `save` returned."""
        self._wanted = dict(saved["wanted"])
        for name, position in saved["held"].items():
            self._hold(self._drives[name], position)

    def _hold(self, drive: JointDrive, position: float) -> None:
        self._held[drive.joint] = position
        self._bullet.setJointMotorControl2(
            self._uid,
            self._indices[drive.joint],
            self._bullet.POSITION_CONTROL,
            targetPosition=position,
            positionGain=GAIN,
            maxVelocity=drive.max_rate,
            force=drive.torque,
        )
