"""The names under which clients ask for cameras."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executor.robots.config import Camera
    from executor.world.interface import Robot, World

__all__ = ["find_camera"]


def find_camera(world: World, name: str) -> tuple[str, Robot, Camera] | None:
    """Returns a camera with its name and robot, or None if the world has none of this name.

    Cameras of the first robot have their sensors' names, those of others `robot/sensor`. "" is the first
    camera of the world.
    """
    for index, robot in enumerate(world.robots):
        for camera in robot.config.cameras:
            known = camera.name if index == 0 else f"{robot.id}/{camera.name}"
            if name in ("", known):
                return known, robot, camera
    return None
