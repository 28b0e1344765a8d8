"""InitialPoseReceived of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or_entry
from tree_gardener.ports import Port


class InitialPoseReceived(Behaviour):
    """Succeeds if `initial_pose_received` is true.

    If the port is not given, the blackboard entry with the port's name is read; without such an entry the
    node fails. Rule: Nav2's plugins/condition/initial_pose_received_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "initial_pose_received": Port(
            bool, description="Whether it was received; the entry of this name if it is not given."
        )
    }

    def update(self) -> Status:
        is_received = input_or_entry(self, "initial_pose_received", otherwise=False)
        return Status.SUCCESS if is_received is True or is_received == 1 else Status.FAILURE
