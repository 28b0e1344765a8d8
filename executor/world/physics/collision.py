"""Counts collisions by episode: a long contact along a wall is one collision."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

EPISODE_GAP_S: Final = 0.5


@dataclass(frozen=True)
class Collision:
    """The start of a collision, with the body that was hit."""

    time_s: float
    body: str


@dataclass
class CollisionCounter:
    """Counts collisions: contacts that are less than `EPISODE_GAP_S` apart belong to one collision."""

    count: int = 0
    last_contact_s: float = float("-inf")

    def observe(self, now_s: float, body: str | None) -> Collision | None:
        """Notes the body in contact, or None without contact.

        Returns a collision when one starts, otherwise None.
        """
        if body is None:
            return None
        is_new = now_s - self.last_contact_s > EPISODE_GAP_S
        self.last_contact_s = now_s
        if not is_new:
            return None
        self.count += 1
        return Collision(now_s, body)
