"""GoalUpdatedController of Nav2."""

from typing import Any

from tree_gardener import DecoratorNode, Port, Status
from tree_gardener.nav2.reading import goals_of


class GoalUpdatedController(DecoratorNode):
    """Ticks its child when it starts and each time that the goal or the goals change.

    In between it is RUNNING; a child that is RUNNING is ticked at every tick. If a port is not given, the
    blackboard entry with the port's name is read. Rule: Nav2's plugins/decorator/goal_updated_controller.cpp.
    """

    INPUT_PORTS = {
        "goal": Port(description="The goal; the entry 'goal' if it is not given."),
        "goals": Port(description="The goals; the entry 'goals' if they are not given."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.goals: tuple[Any, Any] = (None, None)
        self.was_updated = False

    def update(self) -> Status:
        if self.status is Status.IDLE:
            self.goals = goals_of(self, self.goals)
            self.was_updated = True
        self.mark_running()
        goals = goals_of(self)
        if goals != self.goals:
            self.goals = goals
            self.was_updated = True
        if not (self.was_updated or self.child_status() is Status.RUNNING):
            return Status.RUNNING
        self.was_updated = False
        return self.tick_child()
