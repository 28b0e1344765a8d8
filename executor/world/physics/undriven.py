"""A robot's joints without a motor: some turn freely, some follow another joint, some are held."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.robots.urdf import MOVING, Mimic
from executor.world.physics.joints import RobotJoints

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.robots.config import RobotConfig
    from executor.robots.urdf import Joint
    from executor.world.engine import Bullet

FOLLOW_NM: Final = 20.0
"""Torque in Nm, or force in N, of a joint that follows or is held and has no effort in its limit."""
CATCH_UP: Final = 0.5
"""Share of a position error that a following joint corrects in one control period."""


class UndrivenJoints(RobotJoints):
    """Moves the joints that neither the drive nor a motor moves.

    * A joint with `<mimic>` follows the position of the other joint.
    * A continuous joint, as of a castor, turns freely against its friction.
    * Other joints are held where they are.

    Args:
        bullet: the physics server.
        uid: the id of the robot in the physics server.
        config: the configuration of the robot.
        indices: the indices of the joints in the physics server, by name.
    """

    def __init__(self, bullet: Bullet, uid: int, config: RobotConfig, indices: Mapping[str, int]) -> None:
        drive, joints = config.drive, config.urdf.joints
        driven = {*drive.left, *drive.right, *(motor.joint for motor in config.joints)}
        names = [name for name, joint in joints.items() if joint.kind in MOVING and name not in driven]
        super().__init__(bullet, uid, config, {name: indices[name] for name in names})
        self._followed = {
            name: _source(self._joints, mimic)
            for name in names
            if (mimic := self._joints[name].mimic) is not None
        }
        self._sources = {mimic.joint: indices[mimic.joint] for mimic in self._followed.values()}
        for name in names:
            self._set_up(name)

    def control(self, dt_s: float) -> None:
        """Sets the rates of following joints; called at the start of a control period."""
        if not self._followed:
            return
        positions = self._states(self._sources)
        own = self._states({name: self._indices[name] for name in self._followed})
        for name, mimic in self._followed.items():
            position, rate = positions[mimic.joint]
            wanted = self._within(name, mimic.multiplier * position + mimic.offset)
            correction = CATCH_UP * (wanted - own[name][0]) / dt_s
            self._bullet.setJointMotorControl2(
                self._uid,
                self._indices[name],
                self._bullet.VELOCITY_CONTROL,
                targetVelocity=mimic.multiplier * rate + correction,
                force=self._joints[name].effort or FOLLOW_NM,
            )

    def _set_up(self, name: str) -> None:
        joint, index = self._joints[name], self._indices[name]
        is_free = name not in self._followed and joint.kind == "continuous"
        force = joint.friction if is_free else joint.effort or FOLLOW_NM
        # By default Bullet brakes every joint with 1 Nm.
        self._bullet.setJointMotorControl2(
            self._uid, index, self._bullet.VELOCITY_CONTROL, targetVelocity=0.0, force=force
        )


def _source(joints: Mapping[str, Joint], mimic: Mimic) -> Mimic:
    """Returns how a joint follows the one at the end of a chain of joints that follow each other."""
    while (next_ := joints[mimic.joint].mimic) is not None:
        offset = mimic.multiplier * next_.offset + mimic.offset
        mimic = Mimic(next_.joint, mimic.multiplier * next_.multiplier, offset)
    return mimic
