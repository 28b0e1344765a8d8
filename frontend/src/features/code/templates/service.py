import py_trees
from rclpy.node import Node
from std_srvs.srv import Trigger

from tree_gardener.ports import Port, get_input, set_output


class NewAction(py_trees.behaviour.Behaviour):
    """Calls a ROS service and waits for its answer."""

    INPUT_PORTS = {"service": Port(str, default="/trigger", description="Name of the service.")}
    OUTPUT_PORTS = {"answer": Port(str, default="{=}", description="What the service says.")}

    def setup(self, **kwargs):
        self.node: Node = kwargs["node"]
        self.client = None
        self.call = None

    def initialise(self):
        self.call = None
        if self.client is None:
            self.client = self.node.create_client(Trigger, get_input(self, "service"))

    def update(self):
        if self.call is None:
            if not self.client.service_is_ready():
                return py_trees.common.Status.RUNNING
            self.call = self.client.call_async(Trigger.Request())
        if not self.call.done():
            return py_trees.common.Status.RUNNING
        answer = self.call.result()
        set_output(self, "answer", answer.message)
        return py_trees.common.Status.SUCCESS if answer.success else py_trees.common.Status.FAILURE

    def terminate(self, new_status):
        if self.call is not None and not self.call.done():
            self.call.cancel()
