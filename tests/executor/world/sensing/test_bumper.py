import math

import pytest

from executor.world.sensing.bumper import HELD_S, Bumper, Zone, zone_of


@pytest.mark.parametrize(
    ("degrees", "zone"),
    [(0, "center"), (29, "center"), (-29, "center"), (31, "left"), (-31, "right"), (99, "left"), (180, None)],
)
def test_where_it_is_pressed(degrees: float, zone: Zone | None) -> None:
    assert zone_of(math.cos(math.radians(degrees)), math.sin(math.radians(degrees))) == zone


def test_a_short_touch_is_not_missed_and_not_kept() -> None:
    bumper = Bumper()
    bumper.touch(0.2, 0.0, 1.0)
    bumper.touch(-0.2, 0.0, 1.0)
    assert bumper.pressed(1.0 + HELD_S / 2) == {"center"}
    assert bumper.pressed(1.0 + HELD_S * 2) == frozenset()
