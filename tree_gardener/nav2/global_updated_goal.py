"""GlobalUpdatedGoal of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import goals_of
from tree_gardener.ports import Port


class GlobalUpdatedGoal(Behaviour):
    """Succeeds once each time that the goal or the goals change, and at its first tick.

    It remembers them for the life of the tree, even after a reset or halt. If a port is not given, the
    blackboard entry with the port's name is read. Rule: Nav2's
    plugins/condition/globally_updated_goal_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "goal": Port(description="The goal; the entry 'goal' if it is not given."),
        "goals": Port(description="The goals; the entry 'goals' if they are not given."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.goals: tuple[Any, Any] = (None, None)
        self.is_first = True

    def update(self) -> Status:
        goals = goals_of(self)
        if not self.is_first and goals == self.goals:
            return Status.FAILURE
        self.is_first = False
        self.goals = goals
        return Status.SUCCESS
