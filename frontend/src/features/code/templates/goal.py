import py_trees
from action_msgs.msg import GoalStatus
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionClient
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class NewAction(py_trees.behaviour.Behaviour):
    """Sends a goal to a ROS action server and waits until it is reached."""

    INPUT_PORTS = {
        "x": Port(float, default=0.0, description="Target on the map, in m."),
        "y": Port(float, default=0.0, description="Target on the map, in m."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        # This one is Nav2's; another action comes from the package that defines it.
        self.client = ActionClient(node, NavigateToPose, "/navigate_to_pose")
        self.sending = None
        self.result = None

    def initialise(self):
        self.sending = None
        self.result = None

    def update(self):
        if self.sending is None:
            if not self.client.server_is_ready():
                return py_trees.common.Status.RUNNING
            self.sending = self.client.send_goal_async(self.goal())
        if not self.sending.done():
            return py_trees.common.Status.RUNNING
        handle = self.sending.result()
        if not handle.accepted:
            return py_trees.common.Status.FAILURE
        if self.result is None:
            self.result = handle.get_result_async()
        if not self.result.done():
            return py_trees.common.Status.RUNNING
        reached = self.result.result().status == GoalStatus.STATUS_SUCCEEDED
        return py_trees.common.Status.SUCCESS if reached else py_trees.common.Status.FAILURE

    def goal(self):
        goal = NavigateToPose.Goal()
        goal.pose.header.frame_id = "map"
        goal.pose.pose.position.x = get_input(self, "x")
        goal.pose.pose.position.y = get_input(self, "y")
        goal.pose.pose.orientation.w = 1.0
        return goal

    def terminate(self, new_status):
        # Halted: the server is to stop, too, be it that it has not even answered yet.
        if self.sending is not None and new_status == py_trees.common.Status.INVALID:
            self.sending.add_done_callback(cancel)


def cancel(sending):
    handle = sending.result()
    if handle.accepted:
        handle.cancel_goal_async()
