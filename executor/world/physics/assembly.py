"""A model of several links and joints in the physics server: a door, a shelf on castors, a kitchen."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.robots.links import read_links
from executor.robots.prepare import physical_urdf
from executor.robots.urdf import MOVING
from executor.universes.document import DocumentError, Problem
from executor.world.geometry.kinematics import add_links, link_pose
from executor.world.geometry.transforms import Pose, compose, from_xyz_rpy, inverse
from executor.world.physics.placement import put_at_rest

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from executor.messages import Mesh
    from executor.robots.urdf import Urdf
    from executor.universes.model import Model
    from executor.world.engine import Bullet
    from executor.world.geometry.objects import Kind, SceneObjects, Where

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
    return read_links(path, model.file)


class Assembly:
    """A model made from a URDF. Its root is fixed, or free if the model has a mass."""

    def __init__(self, bullet: Bullet, model: Model, links: Links) -> None:
        self._bullet = bullet
        self._model = model
        self._urdf, meshes = links
        pose = from_xyz_rpy(model.pose)
        with physical_urdf(self._urdf.text, meshes) as path:
            self.uid: int = bullet.loadURDF(
                str(path),
                pose[:3],
                pose[3:],
                useFixedBase=model.mass == 0,
                flags=bullet.URDF_USE_INERTIA_FROM_FILE,
            )
        info = bullet.getDynamicsInfo(self.uid, -1)
        self._inertial: Pose = (*info[3], *info[4])
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

    # --- inside ---

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
