"""SmoothPath of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.smooth_path import SmoothPath

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_smoothed_path_and_its_time_are_written(ros: Graph) -> None:
    path = Path(poses=[PoseStamped()])
    took = Duration(sec=1, nanosec=500_000_000)
    server = Actions(
        ros, "SmoothPath", SmoothPath.ACTION_NAME, path=path, smoothing_duration=took, was_completed=True
    )
    ports = "unsmoothed_path='{path}' smoother_id='s' max_smoothing_duration='2' check_for_collisions='true'"
    outputs = "smoothed_path='{smooth}' smoothing_duration='{took}' was_completed='{done}'"
    assert ros.run(f"<SmoothPath {ports} {outputs}/>", path=Path()) is Status.SUCCESS
    (goal,) = server.goals
    assert (goal.smoother_id, goal.max_smoothing_duration.sec, goal.check_for_collisions) == ("s", 2, True)
    assert (ros["smooth"], ros["took"], ros["done"]) == (path, 1.5, True)


def test_a_failure_leaves_the_outputs(ros: Graph) -> None:
    Actions(ros, "SmoothPath", "smooth_path", outcome="abort", error_code=502)
    body = "<SmoothPath unsmoothed_path='{path}' smoothed_path='{smooth}' error_code_id='{code}'/>"
    assert ros.run(body, path=Path(), smooth="before") is Status.FAILURE
    assert (ros["smooth"], ros["code"]) == ("before", 502)
