"""WouldAPlannerRecoveryHelp of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.would_a_planner_recovery_help import WouldAPlannerRecoveryHelp


@pytest.mark.parametrize("code", [200, 207, 208, 300, 307, 308])
def test_a_recovery_may_help(code: int) -> None:
    assert Trial(WouldAPlannerRecoveryHelp, f'error_code="{code}"').tick() == "S"


@pytest.mark.parametrize("code", [0, 201, 206, 309])
def test_no_recovery_helps_and_codes_of_the_port_are_not_read(code: int) -> None:
    ports = f'error_code="{code}" error_codes_to_check="{code}"'
    assert Trial(WouldAPlannerRecoveryHelp, ports).tick() == "F"
