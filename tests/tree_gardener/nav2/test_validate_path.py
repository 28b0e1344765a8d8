"""ValidatePath of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from tests.tree_gardener.nav2_servers import Services
from tree_gardener import Status
from tree_gardener.nav2.validate_path import ValidatePath

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

PATH = Path(poses=[PoseStamped(), PoseStamped(), PoseStamped()])


def test_a_free_path_succeeds(ros: Graph) -> None:
    service = Services(ros, "IsPathValid", ValidatePath.SERVICE_NAME, is_valid=True)
    assert ros.run("<ValidatePath path='{path}' collision_poses='{at}'/>", path=PATH) is Status.SUCCESS
    assert service.requests[0].path == PATH
    assert ros["at"] == []


def test_an_occupied_one_fails_and_names_the_poses(ros: Graph) -> None:
    answer = {"is_valid": False, "invalid_pose_indices": [1, 2]}
    Services(ros, "IsPathValid", "valid", **answer)
    body = "<ValidatePath path='{path}' service_name='valid' collision_poses='{at}'/>"
    assert ros.run(body, path=PATH) is Status.FAILURE
    assert ros["at"] == PATH.poses[1:]
