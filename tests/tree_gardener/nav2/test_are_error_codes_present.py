"""AreErrorCodesPresent of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.are_error_codes_present import AreErrorCodesPresent


def test_the_code_is_one_of_those_to_check() -> None:
    trial = Trial(AreErrorCodesPresent, 'error_code="{code}" error_codes_to_check="{codes}"', codes=[7, 8])
    assert trial.tick() == "F"
    trial["code"] = 8
    assert trial.tick() == "S"
    del trial.tree.blackboard["code"]
    assert trial.tick() == "S"
    trial["code"] = 9
    assert trial.tick() == "F"
    trial["codes"] = [9]  # the list was read before the first tick
    assert trial.tick() == "F"


def test_without_codes_it_fails() -> None:
    assert Trial(AreErrorCodesPresent, 'error_code="1"').tick() == "F"
    assert Trial(AreErrorCodesPresent, 'error_code="1" error_codes_to_check="1;2"').tick() == "S"
