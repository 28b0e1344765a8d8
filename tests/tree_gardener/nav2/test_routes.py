"""Goals of the route server."""

from __future__ import annotations

from typing import Any

import pytest
from nav2_msgs.action import ComputeRoute

from tree_gardener.nav2.routes import set_route_goal


class Leaf:
    """Gives values of ports."""

    def __init__(self, **ports: Any) -> None:
        self.ports = {"use_poses": False, "use_start": False} | ports

    def read(self, name: str) -> Any:
        return self.ports[name]


def goal_of(**ports: Any) -> Any:
    goal = ComputeRoute.Goal()
    leaf: Any = Leaf(**ports)
    set_route_goal(leaf, goal)
    return goal


def test_ids_are_used_without_poses() -> None:
    goal = goal_of(start_id=3, goal_id=4, use_start=True)
    assert (goal.start_id, goal.goal_id, goal.use_poses, goal.use_start) == (3, 4, False, False)


@pytest.mark.parametrize("use_start", [False, True])
def test_poses_are_used_with_a_start_or_without(*, use_start: bool) -> None:
    goal = goal_of(use_poses=True, use_start=use_start, goal="1;2;0", start="3;4;0")
    assert (goal.use_poses, goal.use_start, goal.goal.pose.position.x) == (True, use_start, 1.0)
    assert goal.start.pose.position.x == (3.0 if use_start else 0.0)
