"""Loads the states of worlds in a folder, continues them, and writes how they ended.

`python -m tests.executor.world.physics.continue_world FOLDER`; a file is named `universe.robot`.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from executor.world.simulation.launch import make_world

if TYPE_CHECKING:
    from executor.world.physics.bullet import BulletWorld


def drive(world: BulletWorld) -> bytes:
    """Drives all robots for a while, and returns everything that can be measured then."""
    for turn in range(12):
        for robot in world.robots:
            robot.command(0.3 + 0.01 * (turn % 3), 0.5 - 0.1 * (turn % 7))
        world.step(60)
    said: list[object] = [world.time_s]
    for robot in world.robots:
        said += [robot.odometry, robot.distance_m, robot.collisions, sorted(robot.pressed())]
        said += [robot.joint_states()]
        said += [robot.scan(lidar).ranges.tobytes() for lidar in robot.config.lidars]
        said += [robot.imu(imu) for imu in robot.config.imus]
        said += [robot.battery(battery) for battery in robot.config.batteries]
    return world.poses().tobytes() + repr(said).encode()


def main(folder: Path) -> None:
    for path in sorted(folder.iterdir()):
        universe, robot = path.name.split(".")
        world = make_world(universe, seed=3, robot=robot)
        world.load(path.read_bytes())
        (folder / f"{path.name}.after").write_bytes(drive(world))
        world.close()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
