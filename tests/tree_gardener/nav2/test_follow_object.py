"""FollowObject of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from builtin_interfaces.msg import Duration

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.follow_object import FollowObject

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


@pytest.mark.parametrize(("outcome", "status"), [("succeed", Status.SUCCESS), ("abort", Status.FAILURE)])
def test_the_time_is_written_at_each_end(ros: Graph, outcome: str, status: Status) -> None:
    took = Duration(sec=4)
    server = Actions(ros, "FollowObject", FollowObject.ACTION_NAME, outcome=outcome, total_elapsed_time=took)
    body = "<FollowObject tracked_frame='person' max_duration='8' total_elapsed_time='{took}'/>"
    assert ros.run(body) is status
    (goal,) = server.goals
    assert (goal.pose_topic, goal.tracked_frame, goal.max_duration.sec) == ("dynamic_pose", "person", 8)
    assert ros["took"] == took
