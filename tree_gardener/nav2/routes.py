"""Goals of Nav2's route server from ports."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import pose_from


def set_route_goal(leaf: Nav2Action, goal: Any) -> None:
    """Fills a goal from the ports: with poses, or with the ids of nodes of the route graph."""
    goal.use_poses = bool(leaf.read("use_poses"))
    goal.use_start = False
    if not goal.use_poses:
        goal.start_id, goal.goal_id = int(leaf.read("start_id")), int(leaf.read("goal_id"))
        return
    goal.goal = pose_from(leaf.read("goal"))
    if leaf.read("use_start"):
        goal.start, goal.use_start = pose_from(leaf.read("start")), True
