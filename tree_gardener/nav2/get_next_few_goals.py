"""GetNextFewGoals of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.geometry import copied
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class GetNextFewGoals(Behaviour):
    """Writes the first `num_goals` of the goals, or all if there are fewer. It fails if there are none.

    Rule: Nav2's plugins/action/get_next_few_goals_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "num_goals": Port(int, description="How many goals are taken."),
        "input_goals": Port(description="The goals."),
    }
    OUTPUT_PORTS = {"output_goals": Port(description="The first goals.")}

    def update(self) -> Status:
        goals = input_or(self, "input_goals", None)
        if goals is None or not goals.goals:
            return Status.FAILURE
        count = max(0, input_or(self, "num_goals", 0))
        give(self, "output_goals", copied(goals, goals=list(goals.goals)[:count]))
        return Status.SUCCESS
