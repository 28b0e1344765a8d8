"""SingleTrigger of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.single_trigger import SingleTrigger


def test_the_child_is_ticked_until_it_ends_once() -> None:
    trial = Trial(SingleTrigger, children="RS")
    assert trial.tick() + trial.tick() + trial.again() + trial.again() == "RSFF"
    assert trial.child_ticks == 2


def test_it_starts_again_after_a_reset() -> None:
    trial = Trial(SingleTrigger, children="FKS")
    assert trial.tick() + trial.tick() + trial.again() + trial.again() == "FKSF"
