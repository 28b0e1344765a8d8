"""WouldAControllerRecoveryHelp of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.would_a_controller_recovery_help import WouldAControllerRecoveryHelp


@pytest.mark.parametrize("code", [100, 104, 105, 106])
def test_a_recovery_may_help(code: int) -> None:
    assert Trial(WouldAControllerRecoveryHelp, f'error_code="{code}"').tick() == "S"


@pytest.mark.parametrize("code", [0, 101, 102, 103, 107, 108])
def test_no_recovery_helps_and_codes_of_the_port_are_not_read(code: int) -> None:
    ports = f'error_code="{code}" error_codes_to_check="{code}"'
    assert Trial(WouldAControllerRecoveryHelp, ports).tick() == "F"
