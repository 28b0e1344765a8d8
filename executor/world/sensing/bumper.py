"""A bumper: the zones at the robot's front that are pressed. Pure; time is an argument."""

from __future__ import annotations

import math
from typing import Final, Literal, get_args

Zone = Literal["left", "center", "right"]
ZONES: Final[tuple[Zone, ...]] = get_args(Zone)
CENTER_RAD: Final = math.radians(30)
SIDE_RAD: Final = math.radians(100)
HELD_S: Final = 0.1  # longer than the period of measurements, so that no touch is missed


def zone_of(x: float, y: float) -> Zone | None:
    """Returns the zone of a contact that is x m ahead and y m to the left of the center.

    None if it is behind.
    """
    bearing = math.atan2(y, x)
    if abs(bearing) <= CENTER_RAD:
        return "center"
    if abs(bearing) > SIDE_RAD:
        return None
    return "left" if bearing > 0 else "right"


class Bumper:
    """Stores the last contact of each zone."""

    def __init__(self) -> None:
        self.touched_s: dict[Zone, float] = {}

    def touch(self, x: float, y: float, now_s: float) -> None:
        """Adds a contact in the robot's frame, in m."""
        zone = zone_of(x, y)
        if zone is not None:
            self.touched_s[zone] = now_s

    def pressed(self, now_s: float) -> frozenset[Zone]:
        """Returns the zones that are pressed at this time."""
        return frozenset(zone for zone, then_s in self.touched_s.items() if now_s - then_s <= HELD_S)
