"""A model of several links and joints in the physics server: a door, a shelf on castors, a kitchen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.robots.links import read_links
from executor.robots.prepare import physical_urdf
from executor.robots.urdf import MOVING
from executor.universes.document import DocumentError, Problem
from executor.world.geometry.kinematics import add_links, link_pose
from executor.world.geometry.transforms import Pose, compose, from_xyz_rpy, inverse
from executor.world.physics.placement import put_at_rest
from tree_gardener.packages import Place

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from executor.messages import Mesh
    from executor.robots.urdf import Mimic, Urdf
    from executor.universes.model import Model
    from executor.world.engine import Bullet
    from executor.world.geometry.objects import Kind, SceneObjects, Where

GEAR_FORCE: Final = 1000.0
Links = tuple["Urdf", dict[str, "Mesh"]]


def read_assembly(model: Model, assets: Path | None) -> Links:
    """Reads the links of a model from the project's files.

    Raises:
        DocumentError: the file is missing or invalid; the error has the line.
    """
    if assets is None:
        problem = Problem(f"{model.id!r} needs the project's files", code="BTR002")
        raise DocumentError([problem], model.file)
    path = assets / model.file
    if not path.resolve().is_relative_to(assets.resolve()):
        problem = Problem(f"the file of {model.id!r} lies outside of the project", code="BTR002")
        raise DocumentError([problem], model.file)
    places = [Place(f"the folder of {model.file}", path.parent), Place("the project", assets)]
    return read_links(path, model.file, places)


class Assembly:
    """A model made from a URDF. Its root is fixed, or free if the model has a mass."""

    def __init__(self, bullet: Bullet, model: Model, links: Links) -> None:
        self._bullet = bullet
        self._model = model
        self._urdf, meshes = links
        pose = from_xyz_rpy(model.pose)
        with physical_urdf(self._urdf.text, meshes) as path:
            is_one_body = len(self._urdf.links) == 1
            self.uid = bullet.load_urdf(path, pose, is_fixed=model.mass == 0, is_one_body=is_one_body)
        # Bullet's own answer about the frame of inertia is undefined for a body without joints.
        position, orientation = bullet.getBasePositionAndOrientation(self.uid)
        self._inertial: Pose = compose(inverse(pose), (*position, *orientation))
        self._joints = self._free_joints()
        self._ids: dict[str, int] = {}
        self._set_up()

    @property
    def is_dynamic(self) -> bool:
        """Whether any part of the assembly can move."""
        return self._model.mass > 0 or bool(self._joints)

    def add_to_scene(self, objects: SceneObjects) -> None:
        """Adds the visual shapes of the assembly to the scene."""
        kind: Kind = "dynamic" if self.is_dynamic else "static"
        self._ids = add_links(self._model.id, self._urdf, self._model.file, objects, kind)
        for object_id, pose in self._where()():
            objects.place(object_id, pose)
        if self.is_dynamic:
            objects.add_mover(self._where)

    def move_body(self, pose: Pose, objects: SceneObjects) -> None:
        """Sets the pose of the root; the joints do not change."""
        put_at_rest(self._bullet, self.uid, compose(pose, self._inertial))
        for object_id, link in self._where()():
            objects.place(object_id, link)

    def _where(self) -> Where:
        position, orientation = self._bullet.getBasePositionAndOrientation(self.uid)
        states = self._bullet.getJointStates(self.uid, list(self._joints.values())) if self._joints else ()

        def computed() -> Sequence[tuple[int, Pose]]:
            base = compose((*position, *orientation), inverse(self._inertial))
            positions = {name: state[0] for name, state in zip(self._joints, states, strict=True)}
            return [(id_, link_pose(self._urdf, base, link, positions)) for link, id_ in self._ids.items()]

        return computed

    def _free_joints(self) -> dict[str, int]:
        names = {}
        for index in range(self._bullet.getNumJoints(self.uid)):
            name = self._bullet.getJointInfo(self.uid, index)[1].decode()
            if self._urdf.joints[name].kind in MOVING:
                names[name] = index
        return names

    def _set_up(self) -> None:
        bullet, model = self._bullet, self._model
        links = range(-1, bullet.getNumJoints(self.uid))
        masses = [bullet.getDynamicsInfo(self.uid, link)[0] for link in links]
        share = model.mass / max(sum(masses), 1e-9)
        for link, mass in zip(links, masses, strict=True):
            weight = {"mass": mass * share} if model.mass > 0 else {}
            bullet.changeDynamics(
                self.uid, link, lateralFriction=model.friction, restitution=model.restitution, **weight
            )
            if not model.solid:
                bullet.setCollisionFilterGroupMask(self.uid, link, 0, 0)
        for joint in self._joints.values():
            # By default Bullet holds every joint by a motor. This reduces its force to the joint's own
            # friction.
            friction = bullet.getJointInfo(self.uid, joint)[7]
            bullet.setJointMotorControl2(self.uid, joint, bullet.VELOCITY_CONTROL, force=friction)
        for name, joint in self._joints.items():
            self._follow(joint, self._urdf.joints[name].mimic)

    def _follow(self, joint: int, mimic: Mimic | None) -> None:
        """Couples a joint with `<mimic>` to the other one, as by a gear."""
        leader = None if mimic is None else self._joints.get(mimic.joint)
        if mimic is None or leader is None or mimic.multiplier == 0:
            return
        bullet, at = self._bullet, [0.0, 0.0, 0.0]
        gear = bullet.createConstraint(
            self.uid, leader, self.uid, joint, bullet.JOINT_GEAR, [0.0, 0.0, 1.0], at, at
        )
        # Bullet holds leader + gearRatio · follower at relativePositionTarget.
        bullet.changeConstraint(
            gear,
            gearRatio=-1.0 / mimic.multiplier,
            relativePositionTarget=-mimic.offset / mimic.multiplier,
            erp=0.2,
            maxForce=GEAR_FORCE,
        )
