"""A robot in the physics server. It moves by its wheel motors and by contact only."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from executor.robots.prepare import physical_urdf
from executor.world.geometry.kinematics import add_links, link_pose, sensor_placements
from executor.world.geometry.transforms import Pose, Vector, compose, from_xyz_rpy, inverse, rotation, yaw_of
from executor.world.physics.collision import Collision, CollisionCounter, ContactCounter
from executor.world.physics.drive import DifferentialDrive, DriveState, Odometry, drive_state
from executor.world.physics.joints import JointMotors
from executor.world.physics.undriven import UndrivenJoints
from executor.world.sensing.lidar import LidarCaster
from executor.world.sensing.noise import plain_generator, restore_generator
from executor.world.sensing.proprioception import Proprioception

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Mapping, Sequence

    from executor.messages import SensorPlacement
    from executor.robots.config import Battery, Camera, Imu, Lidar, RobotConfig
    from executor.universes.model import RobotPlace
    from executor.world.engine import Bullet
    from executor.world.geometry.objects import SceneObjects, Where
    from executor.world.geometry.walk import Circle
    from executor.world.interface import LidarReading
    from executor.world.sensing.battery import BatteryReading
    from executor.world.sensing.bumper import Zone
    from executor.world.sensing.imu import ImuReading
    from executor.world.sensing.rays import RayCaster

DEFAULT_FRICTION: Final = 0.8
BLOCKED_NM: Final = 1000.0
PUSH_HZ: Final = 240.0  # an impulse acts for one step
ANY_LINK: Final = -2  # PyBullet's default
MOST_QUESTIONS: Final = 2
DRIVES_TOWARDS: Final = 0.05  # m/s; slower, a robot counts as standing
TOUCH_M: Final = 0.0  # PyBullet reports near misses too, with a positive distance
FIRST_ROBOT_GROUP: Final = 8  # bits 0 to 7 are taken by Bullet and by the groups of models
ALL_GROUPS: Final = 0x7FFF


class BulletRobot:
    """A robot with a differential drive, made from its configuration."""

    def __init__(  # noqa: PLR0913 - a robot, and what it stands in
        self,
        bullet: Bullet,
        rays: RayCaster,
        config: RobotConfig,
        place: RobotPlace,
        *,
        index: int,
        seed: int,
    ) -> None:
        self.id = place.id
        self.config = config
        self.distance_m = 0.0
        self._bullet = bullet
        self._index = index
        self._clock_s = 0.0
        start = from_xyz_rpy(place.pose)
        apart = {*config.wheels, *config.friction, *config.skid}
        with physical_urdf(config.urdf.text, config.meshes, apart) as path:
            self.uid = bullet.load_urdf(path, start)
        self._noise = np.random.default_rng([seed, index])
        self._drive = DifferentialDrive(config.drive, self._noise)
        self._counter = ContactCounter()
        self._carriers: dict[str, tuple[str, Pose]] = {}
        self._proprioception = Proprioception(config, (seed, index), self._pose_of)
        self._joints, self._links = self._index_links()
        self._wheel_joints = [self._joints[name] for name in (*config.drive.left, *config.drive.right)]
        self._wheel_torques = [
            max(0.0, config.drive.wheel_torque - config.urdf.joints[name].friction)
            for name in (*config.drive.left, *config.drive.right)
        ]
        self._motors = JointMotors(bullet, self.uid, config, self._joints)
        self._undriven = UndrivenJoints(bullet, self.uid, config, self._joints)
        self._wheel_links = {self._links[name] for name in config.wheels}
        self._bumping = self._bumping_links()
        self._inertial = self._inertial_inverse()
        self._applied: tuple[float, float] | None = None
        self._blocked_wheels: list[int] = []
        self._at = self.pose[:2]
        self._reach_m = self._reach()
        self._velocity: tuple[Vector, Vector] = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        self._set_up_contact(1 << (FIRST_ROBOT_GROUP + index))
        mask = ALL_GROUPS & ~(1 << (FIRST_ROBOT_GROUP + index))
        self._lidars = {
            lidar.name: LidarCaster(rays, lidar, self.uid, mask, (seed, index, i))
            for i, lidar in enumerate(config.lidars)
        }
        self._drive.observe(*self._wheel_angles(), 0.0)

    @property
    def odometry(self) -> Odometry:
        """Pose and twist of the robot as its wheels measure them."""
        return self._drive.state.odometry

    @property
    def collisions(self) -> int:
        """Number of collisions that the robot caused since the start."""
        return self._counter.collisions.count

    @property
    def hits(self) -> int:
        """Number of times that something that moves ran into the robot, which did not drive towards it."""
        return self._counter.hits.count

    @property
    def footprint(self) -> Circle:
        """The circle on the floor that the robot needs to turn on the spot."""
        return (*self.pose[:2], self._reach_m)

    @property
    def base_pose(self) -> Pose:
        """True pose of the root link."""
        position, orientation = self._bullet.getBasePositionAndOrientation(self.uid)
        return compose((*position, *orientation), self._inertial)

    @property
    def pose(self) -> tuple[float, float, float]:
        """True pose of the robot: x and y in m, yaw in rad."""
        pose = self.base_pose
        return pose[0], pose[1], yaw_of(pose[3:])

    @property
    def bounds(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Lowest and highest corner in m of the bounding box of all collision shapes."""
        boxes = [self._bullet.getAABB(self.uid, link) for link in self._links.values()]
        lows, highs = zip(*boxes, strict=True)
        return tuple(map(min, zip(*lows, strict=True))), tuple(map(max, zip(*highs, strict=True)))

    @property
    def twist(self) -> tuple[float, float, float]:
        """True speed along the robot's x and y in m/s, and about z in rad/s."""
        (x, y, _), (_, _, turn) = self._bullet.getBaseVelocity(self.uid)
        # PyBullet's velocity is that of the centre of mass.
        center, _ = self._bullet.getBasePositionAndOrientation(self.uid)
        base = self.base_pose
        x, y = x + turn * (center[1] - base[1]), y - turn * (center[0] - base[0])
        cosine, sine = math.cos(self.pose[2]), math.sin(self.pose[2])
        return x * cosine + y * sine, y * cosine - x * sine, turn

    def command(self, linear: float, angular: float, at_s: float | None = None) -> bool:
        """Sets the target twist, for now or for an earlier time; returns False if it is not finite."""
        return self._drive.command(linear, angular, self._clock_s if at_s is None else at_s)

    def stop(self) -> None:
        """Sets the target velocity to zero."""
        self._drive.command(0.0, 0.0, self._clock_s)

    def command_joint(self, joint: str, position: float) -> bool:
        """Sets the target position of a motor's joint; returns False if it is not finite."""
        return self._motors.command(joint, position)

    def joint_states(self) -> dict[str, tuple[float, float]]:
        """Returns the position and the rate of each joint that can move; the wheels come first."""
        names = (*self.config.drive.left, *self.config.drive.right)
        states = self._bullet.getJointStates(self.uid, self._wheel_joints)
        wheels = {name: (state[0], state[1]) for name, state in zip(names, states, strict=True)}
        states = wheels | self._motors.states() if self._motors else wheels
        return states | self._undriven.states() if self._undriven else states

    def wheel_power_w(self) -> float:
        """Returns the mechanical power of the wheels' motors, in W; braking counts as driving does."""
        states = self._bullet.getJointStates(self.uid, self._wheel_joints)
        return float(sum(abs(state[1] * state[3]) for state in states))

    def scan(self, lidar: Lidar) -> LidarReading:
        """Returns a scan at the current time."""
        return self._lidars[lidar.name].scan(self._clock_s, self._pose_of(lidar.link))

    def imu(self, imu: Imu) -> ImuReading:
        """Returns a measurement of the IMU at the current time."""
        return self._proprioception.imu(imu, self._clock_s)

    def battery(self, battery: Battery) -> BatteryReading:
        """Returns the current state of the battery."""
        return self._proprioception.battery(battery)

    def pressed(self) -> frozenset[Zone]:
        """Returns the zones of the bumper that are pressed."""
        return self._proprioception.pressed(self._clock_s)

    def camera_pose(self, camera: Camera) -> Pose:
        """Returns the pose of a camera in the world."""
        return self._pose_of(camera.link)

    def control(self, now_s: float, dt_s: float) -> None:
        """Sets the wheels' motors; called at the start of a control period."""
        self._clock_s = now_s
        self._velocity = self._bullet.getBaseVelocity(self.uid)
        rates = self._drive.wheel_rates(now_s, dt_s) if self._proprioception.has_power else (0.0, 0.0)
        if rates != self._applied:
            self._apply(rates)
        if self._motors and self._proprioception.has_power:
            self._motors.control()
        self._undriven.control(dt_s)

    def measure(self, now_s: float, dt_s: float) -> None:
        """Reads the wheels and the inner sensors; called at the end of a control period."""
        self._clock_s = now_s
        self._drive.observe(*self._wheel_angles(), dt_s)
        center, turn = self._bullet.getBasePositionAndOrientation(self.uid)
        base = compose((*center, *turn), self._inertial)
        self._feel(base, center, dt_s)
        x, y = base[:2]
        moved = math.dist((x, y), self._at)
        if moved > 1e-5:  # m; smaller motions are jitter of the solver
            self.distance_m += moved
            self._at = (x, y)

    def observe_contact(
        self, now_s: float, names: Mapping[int, str], movers: Container[int]
    ) -> list[Collision]:
        """Reads the contacts of the robot; called once in each physics step.

        Args:
            now_s: the simulated time.
            names: what counts as touched, by body; the ground does not.
            movers: the bodies that can run into the robot.

        Returns the collisions that start.
        """
        self._clock_s = now_s
        fixed = mover = None
        drives_towards = False
        for contact in self._contacts():
            body = names.get(contact[2])
            if body is None:
                continue
            self._proprioception.touch(contact[5], now_s)
            if contact[2] in movers:
                mover = mover or body
                drives_towards = drives_towards or self._speed_towards(contact) > DRIVES_TOWARDS
            else:
                fixed = fixed or body
        if fixed is mover is None:
            return []
        return self._counter.observe(now_s, fixed, mover, drives_towards=drives_towards)

    @property
    def has_drawn(self) -> bool:
        """Whether the robot's results may depend on random numbers.

        These are noise of its LIDARs or wheels, or of an IMU that was read.
        """
        config = self.config
        is_noisy = config.drive.slip_noise > 0 or any(lidar.noise_m > 0 for lidar in config.lidars)
        return is_noisy or self._proprioception.has_drawn

    def slip(self, wheel: str, factor: float) -> None:
        """Multiplies the friction of a wheel, which is given by its joint."""
        index = self._joints[wheel]
        link = next(name for name, number in self._links.items() if number == index)
        friction = self.config.friction.get(link, DEFAULT_FRICTION) * factor
        self._bullet.changeDynamics(self.uid, index, lateralFriction=friction)

    def block(self, wheel: str, *, on: bool) -> None:
        """Blocks a wheel, which is given by its joint, or frees it."""
        (self._blocked_wheels.append if on else self._blocked_wheels.remove)(self._joints[wheel])
        self._applied = None

    def scale_noise(self, sensor: str, factor: float) -> None:
        """Multiplies the noise of a LIDAR or an IMU."""
        if sensor in self._lidars:
            self._lidars[sensor].noise_factor = factor
        else:
            self._proprioception.scale_noise(sensor, factor)

    def reseed(self, seed: int) -> None:
        """Draws all noise from another seed from now on."""
        drawn = np.random.default_rng([seed, self._index])
        self._noise.bit_generator.state = drawn.bit_generator.state  # the drive has this generator, too
        self._proprioception.reseed((seed, self._index))
        for i, lidar in enumerate(self._lidars.values()):
            lidar.seed = (seed, self._index, i)

    def push(self, impulse_n_s: Vector) -> None:
        """Applies an impulse at the centre of mass during the next step, in the world frame, in N·s."""
        center, _ = self._bullet.getBasePositionAndOrientation(self.uid)
        force = [value * PUSH_HZ for value in impulse_n_s]
        self._bullet.applyExternalForce(self.uid, -1, force, center, self._bullet.WORLD_FRAME)

    def moved_by_hand(self) -> None:
        """Notes that a user moved the robot; such a move does not count as travelled distance."""
        self._at = self.pose[:2]
        self._drive.state = DriveState(
            wheel_angles=self._drive.state.wheel_angles, odometry=self._drive.state.odometry
        )
        self._apply((0.0, 0.0))

    def save(self) -> dict[str, Any]:
        """Returns the state that the physics server does not save itself, as plain data."""
        return {
            "drive": self._drive.state,
            "collisions": self._counter.collisions.saved,
            "hits": self._counter.hits.saved,
            "distance_m": self.distance_m,
            "at": self._at,
            "noise": plain_generator(self._noise),
            "senses": self._proprioception.save(),
            "motors": self._motors.save(),
        }

    def restore(self, saved: Mapping[str, Any], now_s: float) -> None:
        """Restores a state that `save` returned."""
        self._clock_s = now_s
        self._drive.state = drive_state(saved["drive"])
        hits = saved.get("hits", ())  # recordings of older versions have none
        self._counter = ContactCounter(CollisionCounter(*saved["collisions"]), CollisionCounter(*hits))
        self.distance_m, self._at = saved["distance_m"], (saved["at"][0], saved["at"][1])
        restore_generator(self._noise, saved["noise"])
        self._proprioception.restore(saved["senses"])
        self._motors.restore(saved["motors"])
        drive = self.config.drive
        half_track, radius = drive.track * drive.turn_factor / 2, drive.wheel_radius
        state = self._drive.state
        linear, turn = state.linear, state.angular * half_track
        rates = ((linear - turn) / radius, (linear + turn) / radius)
        self._apply(rates if self._proprioception.has_power else (0.0, 0.0))

    def add_to_scene(self, objects: SceneObjects, sensors: list[SensorPlacement]) -> None:
        """Adds the robot's visual shapes to the scene, and its sensors to the list."""
        ids = add_links(self.id, self.config.urdf, self.config.id, objects, "robot")
        objects.add_mover(lambda: self._where(ids))
        sensors += sensor_placements(self.config, ids)

    def _contacts(self) -> Iterator[Sequence[Any]]:
        """Yields PyBullet's contact points, except those of wheels."""
        for link in self._bumping:
            for contact in self._bullet.getContactPoints(bodyA=self.uid, linkIndexA=link):
                if contact[8] <= TOUCH_M and contact[3] not in self._wheel_links:
                    yield contact

    def _speed_towards(self, contact: Sequence[Any]) -> float:
        """Returns the speed at which the robot's point drove towards the other body before they touched."""
        linear, turn = (np.array(part) for part in self._velocity)
        center, _ = self._bullet.getBasePositionAndOrientation(self.uid)
        arm = np.array(contact[5]) - center
        return -float((linear + np.cross(turn, arm)) @ np.array(contact[7]))

    def _reach(self) -> float:
        """Returns the distance in m from the middle to the farthest corner of the bounding box."""
        (x, y, *_), (low, high) = self.pose, self.bounds
        return max(math.dist((x, y), (a, b)) for a in (low[0], high[0]) for b in (low[1], high[1]))

    def _where(self, ids: dict[str, int]) -> Where:
        base, positions = self.base_pose, self._positions()
        urdf = self.config.urdf
        return lambda: [
            (object_id, link_pose(urdf, base, link, positions)) for link, object_id in ids.items()
        ]

    def _pose_of(self, link: str, base: Pose | None = None) -> Pose:
        carrier, offset = self._carriers.get(link) or self._find_carrier(link)
        base = base or self.base_pose
        if carrier != self.config.urdf.root:
            base = link_pose(self.config.urdf, base, carrier, self._positions())
        return compose(base, offset)

    def _find_carrier(self, link: str) -> tuple[str, Pose]:
        found = self._carriers[link] = self.config.urdf.rigid_parent(link)
        return found

    def _positions(self) -> dict[str, float]:
        return {name: state[0] for name, state in self.joint_states().items()}

    def _feel(self, base: Pose, center: Vector, dt_s: float) -> None:
        drive, odometry = self.config.drive, self._drive.state.odometry
        effort = abs(odometry.linear) / drive.max_linear + abs(odometry.angular) / drive.max_angular
        self._proprioception.drain(effort, dt_s)
        if self._proprioception.has_imu:
            linear, rate = self._bullet.getBaseVelocity(self.uid)
            self._proprioception.move(base, center, linear, rate, dt_s)

    def _wheel_angles(self) -> tuple[float, float]:
        states = self._bullet.getJointStates(self.uid, self._wheel_joints)
        on_left = len(self.config.drive.left)
        left = sum(state[0] for state in states[:on_left]) / on_left
        right = sum(state[0] for state in states[on_left:]) / (len(states) - on_left)
        return left, right

    def _apply(self, rates: tuple[float, float]) -> None:
        left, right = rates
        drive = self.config.drive
        targets = [left] * len(drive.left) + [right] * len(drive.right)
        self._bullet.setJointMotorControlArray(
            self.uid,
            self._wheel_joints,
            self._bullet.VELOCITY_CONTROL,
            targetVelocities=targets,
            forces=self._wheel_torques,
        )
        for wheel in self._blocked_wheels:
            self._bullet.setJointMotorControl2(
                self.uid, wheel, self._bullet.VELOCITY_CONTROL, targetVelocity=0.0, force=BLOCKED_NM
            )
        self._applied = rates

    def _index_links(self) -> tuple[dict[str, int], dict[str, int]]:
        joints: dict[str, int] = {}
        links = {self.config.urdf.root: -1}
        for index in range(self._bullet.getNumJoints(self.uid)):
            info = self._bullet.getJointInfo(self.uid, index)
            joints[info[1].decode()] = index
            links[info[12].decode()] = index
        return joints, links

    def _bumping_links(self) -> list[int]:
        """Returns the links to query for contacts.

        If single queries would cost more, one query for all links.
        """
        solid = [
            index
            for index in self._links.values()
            if index not in self._wheel_links and self._bullet.getCollisionShapeData(self.uid, index)
        ]
        return solid if len(solid) <= MOST_QUESTIONS else [ANY_LINK]

    def _inertial_inverse(self) -> Pose:
        info = self._bullet.getDynamicsInfo(self.uid, -1)
        return inverse((*info[3], *info[4]))

    def _sideways(self, link: str, index: int) -> list[float]:
        """Returns the factors of a link's friction: `skid` along its wheel's axis, or else along y, 1 across.

        Bullet's axes are those of the frame of the inertia, which may be turned in the link's.
        """
        joint = self.config.urdf.joint_above.get(link)
        axis = joint.axis if joint is not None and joint.kind == "continuous" else (0.0, 1.0, 0.0)
        frame = rotation(self._bullet.getDynamicsInfo(self.uid, index)[4])
        along = int(np.abs(frame.T @ np.array(axis)).argmax())
        return [self.config.skid[link] if i == along else 1.0 for i in range(3)]

    def _set_up_contact(self, group: int) -> None:
        for name, index in self._links.items():
            self._bullet.setCollisionFilterGroupMask(self.uid, index, group, ALL_GROUPS)
            friction = self.config.friction.get(name, DEFAULT_FRICTION)
            self._bullet.changeDynamics(
                self.uid, index, lateralFriction=friction, linearDamping=0.0, angularDamping=0.0,
                rollingFriction=0.0, spinningFriction=0.0, restitution=0.0,
            )  # fmt: skip
            if name in self.config.skid:
                self._bullet.changeDynamics(self.uid, index, anisotropicFriction=self._sideways(name, index))
        self._bullet.changeDynamics(
            self.uid, -1, activationState=self._bullet.ACTIVATION_STATE_DISABLE_SLEEPING
        )
