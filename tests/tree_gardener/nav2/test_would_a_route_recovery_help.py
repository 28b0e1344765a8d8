"""WouldARouteRecoveryHelp of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.would_a_route_recovery_help import WouldARouteRecoveryHelp


@pytest.mark.parametrize("code", [400, 404, 405])
def test_a_recovery_may_help(code: int) -> None:
    assert Trial(WouldARouteRecoveryHelp, f'error_code="{code}"').tick() == "S"


@pytest.mark.parametrize("code", [0, 401, 402, 403, 406])
def test_no_recovery_helps_and_codes_of_the_port_are_not_read(code: int) -> None:
    ports = f'error_code="{code}" error_codes_to_check="{code}"'
    assert Trial(WouldARouteRecoveryHelp, ports).tick() == "F"
