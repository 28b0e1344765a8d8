"""Counts collisions by episode: a long contact along a wall is one collision.

A robot is *hit* where something that moves runs into it, and it did not drive towards that thing.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

EPISODE_GAP_S: Final = 0.5


@dataclass(frozen=True)
class Collision:
    """The start of a collision with a body; the robot did not cause it if `is_hit`."""

    time_s: float
    body: str
    is_hit: bool = False

    def told(self, robot: str) -> str:
        """Returns the sentence for logs."""
        return f"{robot} was hit by {self.body}" if self.is_hit else f"{robot} bumped into {self.body}"


@dataclass
class CollisionCounter:
    """Counts collisions: contacts that are less than `EPISODE_GAP_S` apart belong to one collision."""

    count: int = 0
    last_contact_s: float = float("-inf")

    @property
    def saved(self) -> list[float]:
        """The arguments that make it again."""
        return [self.count, self.last_contact_s]

    def is_on(self, now_s: float) -> bool:
        """Returns whether an episode has not ended yet."""
        return now_s - self.last_contact_s <= EPISODE_GAP_S

    def observe(self, now_s: float, body: str | None) -> Collision | None:
        """Notes the body in contact, or None without contact.

        Returns a collision when one starts, otherwise None.
        """
        if body is None:
            return None
        is_new = not self.is_on(now_s)
        self.last_contact_s = now_s
        if not is_new:
            return None
        self.count += 1
        return Collision(now_s, body)


@dataclass
class ContactCounter:
    """Counts the collisions that a robot caused, and apart from them how often it was hit.

    Who caused a contact is decided when it begins: afterwards both push.
    """

    collisions: CollisionCounter = field(default_factory=CollisionCounter)
    hits: CollisionCounter = field(default_factory=CollisionCounter)

    def observe(
        self, now_s: float, fixed: str | None, mover: str | None, *, drives_towards: bool
    ) -> list[Collision]:
        """Notes what the robot touches: a body that never moves, and one that can.

        `drives_towards` says whether the robot drove towards the mover. Returns the collisions that start.
        """
        is_hit = self.hits.is_on(now_s) or not (drives_towards or self.collisions.is_on(now_s))
        hit = self.hits.observe(now_s, mover if is_hit else None)
        caused = self.collisions.observe(now_s, fixed or (None if is_hit else mover))
        found = [caused] if caused else []
        return [*found, Collision(hit.time_s, hit.body, is_hit=True)] if hit else found
