"""WouldASmootherRecoveryHelp of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.would_a_smoother_recovery_help import WouldASmootherRecoveryHelp


@pytest.mark.parametrize("code", [500, 502, 503, 504])
def test_a_recovery_may_help(code: int) -> None:
    assert Trial(WouldASmootherRecoveryHelp, f'error_code="{code}"').tick() == "S"


@pytest.mark.parametrize("code", [0, 501, 505])
def test_no_recovery_helps_and_codes_of_the_port_are_not_read(code: int) -> None:
    ports = f'error_code="{code}" error_codes_to_check="{code}"'
    assert Trial(WouldASmootherRecoveryHelp, ports).tick() == "F"
