"""FollowPath of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.follow_path import FollowPath

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def path_to(x: float) -> Path:
    pose = PoseStamped()
    pose.pose.position.x = x
    return Path(poses=[pose])


def test_the_path_is_followed_by_the_chosen_plugins(ros: Graph) -> None:
    server = Actions(ros, "FollowPath", FollowPath.ACTION_NAME)
    ports = "path='{path}' controller_id='c' goal_checker_id='g' progress_checker_id='p'"
    assert ros.run(f"<FollowPath {ports}/>", path=path_to(1.0)) is Status.SUCCESS
    (goal,) = server.goals
    assert (goal.controller_id, goal.goal_checker_id, goal.progress_checker_id) == ("c", "g", "p")
    assert goal.path == path_to(1.0)


def test_a_controller_that_nothing_has_chosen_is_left_to_the_server(ros: Graph) -> None:
    server = Actions(ros, "FollowPath", FollowPath.ACTION_NAME)
    ros.load("<FollowPath path='{path}' controller_id='{chosen}'/>", path=path_to(1.0))
    assert ros.run() is Status.SUCCESS
    assert [goal.controller_id for goal in server.goals] == [""]


def test_a_new_path_replaces_the_one_under_way_without_a_stop(ros: Graph) -> None:
    server = Actions(ros, "FollowPath", FollowPath.ACTION_NAME, outcome="wait")
    ros.load("<FollowPath path='{path}'/>", path=path_to(1.0))
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and len(server.goals) == 1)
    ros.tree.blackboard["path"] = path_to(2.0)
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and len(server.goals) == 2)
    assert server.cancelled == 0
    assert [goal.path.poses[0].pose.position.x for goal in server.goals] == [1.0, 2.0]
    ros.tree.halt()
    ros.spin(lambda: server.cancelled > 0)
