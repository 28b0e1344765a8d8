"""Distances between a robot and the things of a world, in m, measured on their collision shapes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from executor.world.engine import Bullet
    from executor.world.physics.bullet import BulletWorld
    from executor.world.physics.robot import BulletRobot

    Box = tuple[Sequence[float], Sequence[float]]

FARTHEST_M: Final = 5.0
"""Things farther away than this do not count as near."""
MARGIN_M: Final = 0.02
AWAY_M: Final = 0.5
THICKNESS_M: Final = 0.01


class Clearance:
    """The smallest distance so far of a robot from some bodies.

    Only things nearer than the smallest distance so far are measured, so most calls cost little.
    """

    def __init__(self, bullet: Bullet, robot: BulletRobot, bodies: Collection[int]) -> None:
        self._bullet = bullet
        self._robot = robot
        self._bodies = frozenset(bodies) - {robot.uid}
        self._radius = radius_of(robot)
        self.smallest_m: float | None = None
        """None if nothing was near."""

    def look(self) -> None:
        """Measures at the current moment."""
        limit = FARTHEST_M if self.smallest_m is None else self.smallest_m
        if not self._bodies or limit <= 0:
            return
        bullet, uid = self._bullet, self._robot.uid
        x, y, z = self._robot.base_pose[:3]
        reach = self._radius + limit
        found = bullet.getOverlappingObjects(
            (x - reach, y - reach, z - reach), (x + reach, y + reach, z + reach)
        )
        for body in sorted({pair[0] for pair in found or ()} & self._bodies):
            for point in bullet.getClosestPoints(uid, body, limit):
                limit = min(limit, max(point[8], 0.0))
                self.smallest_m = limit


def bodies_to(world: BulletWorld, what: str) -> list[int]:
    """Returns the bodies that `to` names: anything, models, actors, robots, or the id of one thing.

    Raises:
        KeyError: there is no such thing.
    """
    universe, solids = world.universe, world.solids()
    groups: Mapping[str, list[str]] = {
        "anything": list(solids),
        "models": [model.id for model in universe.models if model.id in solids],
        "actors": [actor.id for actor in universe.actors],
        "robots": [robot.id for robot in universe.robots],
    }
    return [uid for id_ in groups.get(what, [what]) for uid in solids[id_]]


class Placement:
    """Finds whether a thing of a world stands in another one, by its box with a margin of 2 cm.

    Args:
        world: a world of its own, whose things are moved.
    """

    def __init__(self, world: BulletWorld) -> None:
        self._world = world
        self._boxes: dict[str, Box] = {}
        universe = world.universe
        self._poses: dict[str, tuple[float, ...]] = {model.id: model.pose for model in universe.models}
        self._poses |= {robot.id: robot.pose for robot in universe.robots}

    def move(self, id_: str, pose: tuple[float, ...]) -> None:
        """Moves a thing, unless it stands there already."""
        if self._poses[id_] != pose:
            self._world.move_body(id_, pose)
            self._poses[id_] = pose

    def overlaps(self, id_: str, ignored: frozenset[str]) -> bool:
        """Returns whether the box of a thing touches another thing, other than those that are ignored."""
        bullet, solids = self._world.bullet, self._world.solids()
        if id_ not in solids:
            return False
        pose = self._poses[id_]
        low, high = self._box(id_, solids[id_][0])
        turn = bullet.getQuaternionFromEuler(pose[3:])
        middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
        at, _ = bullet.multiplyTransforms(pose[:3], turn, middle, (0, 0, 0, 1))
        half = [(b - a) / 2 + MARGIN_M for a, b in zip(low, high, strict=True)]
        box = bullet.createMultiBody(
            0, bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=half), -1, at, turn
        )
        others = [
            uid for other, uids in solids.items() if other != id_ and other not in ignored for uid in uids
        ]
        touches = any(bullet.getClosestPoints(box, uid, 0.0) for uid in others)
        bullet.removeBody(box)
        return touches

    def _box(self, id_: str, uid: int) -> Box:
        """Returns the lowest and the highest corner of a thing that stands at the origin."""
        if id_ not in self._boxes:
            pose = self._poses[id_]
            self.move(id_, (0.0,) * 6)
            self._boxes[id_] = _tight_box(self._world.bullet, uid)
            self.move(id_, pose)
        return self._boxes[id_]


def _tight_box(bullet: Bullet, uid: int) -> Box:
    """Returns the smallest box round a body, by its distances from six plates; Bullet's own box is larger."""
    boxes = [bullet.getAABB(uid, link) for link in range(-1, bullet.getNumJoints(uid))]
    lows, highs = zip(*boxes, strict=True)
    low, high = (
        [min(each) for each in zip(*lows, strict=True)],
        [max(each) for each in zip(*highs, strict=True)],
    )
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    size = max(b - a for a, b in zip(low, high, strict=True)) + 2 * AWAY_M
    for axis in range(3):
        half = [size] * 3
        half[axis] = THICKNESS_M
        shape = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=half)
        for side, bounds in ((-1, low), (1, high)):
            at = list(middle)
            at[axis] = bounds[axis] + side * (AWAY_M + THICKNESS_M)
            plate = bullet.createMultiBody(0, shape, -1, at)
            near = [point[8] for point in bullet.getClosestPoints(plate, uid, size)]
            bounds[axis] += side * (AWAY_M - min(near, default=AWAY_M))
            bullet.removeBody(plate)
    return low, high


def radius_of(robot: BulletRobot) -> float:
    """Returns the distance of the robot's farthest point from its base."""
    x, y, z = robot.base_pose[:3]
    low, high = robot.bounds
    return math.hypot(
        *(max(at - least, most - at) for at, least, most in zip((x, y, z), low, high, strict=True))
    )
