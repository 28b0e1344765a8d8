"""GoalUpdater of Nav2."""

from typing import Any

from tree_gardener import DecoratorNode, Port, Status
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.nav2.topics import Topic, message_class, parameter


class GoalUpdater(DecoratorNode):
    """Writes the goal, and the goals, that were received on topics, and ticks its child.

    A received goal replaces the input if its stamp is not zero and not older than the input's; else the input
    is written. The same holds for goals; an empty message of goals is ignored. Without ROS the inputs are
    written. Topics: the ROS node's parameters `goal_updater_topic` (goal_update) and `goals_updater_topic`
    (goals_update). Rule: Nav2's plugins/decorator/goal_updater_node.cpp.
    """

    INPUT_PORTS = {
        "input_goal": Port(description="The original goal."),
        "input_goals": Port(description="The original goals."),
    }
    OUTPUT_PORTS = {
        "output_goal": Port(description="The updated goal."),
        "output_goals": Port(description="The updated goals."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.ros_node = kwargs.get("node")
        self.goal = Topic(self.ros_node, "geometry_msgs", "PoseStamped")
        self.goals = Topic(self.ros_node, "nav_msgs", "Goals")
        self.follow()

    def follow(self) -> None:
        """Subscribes to the topics that the parameters name."""
        self.goal.follow(parameter(self.ros_node, "goal_updater_topic", "goal_update"))
        self.goals.follow(parameter(self.ros_node, "goals_updater_topic", "goals_update"))

    def update(self) -> Status:
        if self.status is Status.IDLE:
            self.follow()
        self.write("goal", self.goal.message, ("geometry_msgs", "PoseStamped"))
        goals = self.goals.message
        has_goals = goals is not None and goals.goals
        self.write("goals", goals if has_goals else None, ("nav_msgs", "Goals"))
        return self.tick_child()

    def write(self, what: str, received: Any, kind: tuple[str, str]) -> None:
        """Writes the received message, or the input if that is newer."""
        given = input_or(self, f"input_{what}", None)
        if received is not None and _time(received) != (0, 0) and _time(received) >= _time(given):
            give(self, f"output_{what}", received)
        elif given is not None:
            give(self, f"output_{what}", given)
        elif self.ros_node is not None:
            give(self, f"output_{what}", message_class(*kind)())

    def shutdown(self) -> None:
        self.goal.close()
        self.goals.close()


def _time(message: Any) -> tuple[int, int]:
    """Returns the stamp of a message; zero without a message."""
    return (0, 0) if message is None else (message.header.stamp.sec, message.header.stamp.nanosec)
