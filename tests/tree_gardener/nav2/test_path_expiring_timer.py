"""PathExpiringTimer of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial, path
from tree_gardener.nav2.path_expiring_timer import PathExpiringTimer


def test_it_succeeds_when_the_path_was_not_renewed() -> None:
    trial = Trial(PathExpiringTimer, 'seconds="1.0" path="{path}"', path=path(0.0, 1.0))
    assert trial.tick() == "F"
    trial.clock.advance(0.9)
    trial["path"] = path(0.0, 2.0)
    assert trial.tick() == "F"
    trial.clock.advance(0.9)
    assert trial.tick() == "F"
    trial.clock.advance(0.1)
    assert trial.tick() + trial.tick() == "SF"
