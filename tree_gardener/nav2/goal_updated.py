"""GoalUpdated of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import goals_of, is_active
from tree_gardener.ports import Port


class GoalUpdated(Behaviour):
    """Succeeds once each time that the goal or the goals change.

    When it starts it remembers them and fails. If a port is not given, the blackboard entry with the port's
    name is read. Rule: Nav2's plugins/condition/goal_updated_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "goal": Port(description="The goal; the entry 'goal' if it is not given."),
        "goals": Port(description="The goals; the entry 'goals' if they are not given."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.goals: tuple[Any, Any] = (None, None)

    def update(self) -> Status:
        if not is_active(self):
            self.goals = goals_of(self, self.goals)
            return Status.FAILURE
        goals = goals_of(self)
        if goals == self.goals:
            return Status.FAILURE
        self.goals = goals
        return Status.SUCCESS
