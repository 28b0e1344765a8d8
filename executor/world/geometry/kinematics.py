"""Poses and scene objects of a robot's links. Pure geometry."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from executor.messages import SensorPlacement, Shape
from executor.world.geometry.transforms import IDENTITY, Pose, compose, quaternion_about

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.robots.config import RobotConfig
    from executor.robots.urdf import Joint, Urdf, Visual
    from executor.world.geometry.objects import Kind, SceneObjects


def joint_pose(joint: Joint, position: float) -> Pose:
    """Returns the pose of a joint's child in its parent's frame, at an angle in rad or a shift in m."""
    if joint.kind == "prismatic":
        x, y, z = (value * position for value in joint.axis)
        return compose(joint.origin, (x, y, z, 0.0, 0.0, 0.0, 1.0))
    return compose(joint.origin, (0.0, 0.0, 0.0, *quaternion_about(joint.axis, position)))


def link_pose(urdf: Urdf, base: Pose, link: str, positions: Mapping[str, float]) -> Pose:
    """Returns the pose of a link, from the pose of the root and the positions of the joints (default 0)."""
    chain: list[Joint] = []
    while (joint := urdf.joint_above.get(link)) is not None:
        chain.append(joint)
        link = joint.parent
    pose = base
    for joint in reversed(chain):
        position = positions.get(joint.name, 0.0)
        pose = compose(pose, joint.origin if position == 0.0 else joint_pose(joint, position))
    return pose


def add_links(body: str, urdf: Urdf, meshes: str, objects: SceneObjects, kind: Kind) -> dict[str, int]:
    """Adds one object for the root with its fixed links, and one for each moving link.

    Args:
        body: the body to which the links belong.
        urdf: the links.
        meshes: the prefix of the names of the links' meshes in the scene.
        objects: the scene objects, to which the new ones are added.
        kind: the kind of all new objects.
    """
    shapes: dict[str, list[Shape]] = {}
    for link in urdf.links.values():
        carrier, pose = urdf.rigid_parent(link.name)
        shapes.setdefault(carrier, []).extend(_shape(meshes, visual, pose) for visual in link.visuals)
    return {
        link: objects.add(body, link, kind, link_shapes, IDENTITY) for link, link_shapes in shapes.items()
    }


def sensor_placements(config: RobotConfig, ids: Mapping[str, int]) -> list[SensorPlacement]:
    """Returns the placements of LIDARs and cameras, for clients that draw them."""
    placed = []
    for lidar in config.lidars:
        carrier, pose = config.urdf.rigid_parent(lidar.link)
        fov = min(lidar.fov, 2 * math.pi)
        placed.append(SensorPlacement(lidar.name, "lidar", ids[carrier], list(pose), fov, lidar.range_max))
    for camera in config.cameras:
        carrier, pose = config.urdf.rigid_parent(camera.link)
        placed.append(
            SensorPlacement(camera.name, "camera", ids[carrier], list(pose), camera.fov, camera.far)
        )
    return placed


def mesh_key(of: str, name: str) -> str:
    """Returns the name of a mesh in the scene: two robots may have meshes of the same name."""
    return f"{of}/{name}"


def _shape(meshes: str, visual: Visual, carrier: Pose) -> Shape:
    pose = compose(carrier, visual.pose)
    return Shape(
        shape=visual.shape,  # type: ignore[arg-type]
        size=list(visual.size),
        pose=list(pose),
        color=list(visual.color),
        mesh=mesh_key(meshes, visual.file) if visual.file else "",
    )
