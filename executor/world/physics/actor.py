"""Actors in the physics server: bodies that are moved along their path; robots can bump into them."""

from __future__ import annotations

from dataclasses import astuple
from typing import TYPE_CHECKING

from executor.world.geometry.person import Part, person_parts
from executor.world.geometry.transforms import from_xyz_rpy
from executor.world.geometry.walk import Gait, Path, Walker
from executor.world.physics.bodies import capsule, rgba
from executor.world.physics.placement import put

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from executor.universes.model import Actor
    from executor.world.engine import Bullet
    from executor.world.geometry.objects import SceneObjects, Where
    from executor.world.geometry.walk import Circle


class BulletActor:
    """A person who walks and is not affected by collisions.

    Attributes:
        yields: whether the person waits for a robot in the way.
    """

    def __init__(self, bullet: Bullet, actor: Actor) -> None:
        self.id = actor.id
        self.yields = actor.yields
        self._bullet = bullet
        self._walker = Walker(Path(actor.path, loop=actor.loop), actor.speed, actor.start_m)
        self._parts = person_parts(rgba(actor.color))
        self._solid = [
            (
                part,
                capsule(
                    bullet, part.capsule[0], part.capsule[1], from_xyz_rpy((0, 0, part.capsule[2], 0, 0, 0))
                ),
            )
            for part in self._parts
            if part.capsule is not None
        ]
        self._carry()

    @property
    def uids(self) -> list[int]:
        """The bodies of the actor in the physics server."""
        return [uid for _, uid in self._solid]

    @property
    def position(self) -> tuple[float, float]:
        """Position of the actor in m."""
        return self._walker.gait.x, self._walker.gait.y

    def advance(self, dt_s: float, robots: Iterable[Circle] = ()) -> None:
        """Walks for `dt_s`; one who yields waits for robots, given by their circles."""
        self._walker.advance(dt_s, robots if self.yields else ())
        self._carry()

    def save(self) -> list[float]:
        """Returns the state for `restore`, as plain data."""
        return list(astuple(self._walker.gait))

    def restore(self, saved: Sequence[float]) -> None:
        """Restores a state that `save` returned."""
        self._walker.gait = Gait(*saved)
        self._carry()

    def add_to_scene(self, objects: SceneObjects) -> None:
        """Adds a scene object for each part of the actor."""
        ids = [
            (objects.add(self.id, part.name, "actor", list(part.shapes), part.pose(self._walker.gait)), part)
            for part in self._parts
        ]
        objects.add_mover(lambda: self._where(ids))

    def _where(self, ids: list[tuple[int, Part]]) -> Where:
        gait = self._walker.gait
        return lambda: [(object_id, part.pose(gait)) for object_id, part in ids]

    def _carry(self) -> None:
        for part, uid in self._solid:
            put(self._bullet, uid, part.pose(self._walker.gait))
