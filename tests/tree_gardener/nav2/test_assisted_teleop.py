"""AssistedTeleop of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.assisted_teleop import AssistedTeleop

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


@pytest.mark.parametrize(("port", "status"), [("true", Status.FAILURE), ("false", Status.SUCCESS)])
def test_a_failure_counts_if_it_is_a_recovery(ros: Graph, port: str, status: Status) -> None:
    server = Actions(ros, "AssistedTeleop", AssistedTeleop.ACTION_NAME, outcome="abort", error_code=731)
    body = f"<AssistedTeleop is_recovery='{port}' time_allowance='3' error_code_id='{{code}}'/>"
    assert ros.run(body) is status
    assert (server.goals[0].time_allowance.sec, ros["code"]) == (3, 731)
