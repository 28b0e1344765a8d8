export type ActionTemplate = 'action' | 'condition' | 'service';

const ACTION = (name: string) => `import py_trees
from geometry_msgs.msg import Twist

from tree_gardener.ports import Port, get_input


class ${name}(py_trees.behaviour.Behaviour):
    """Says in one line what it does."""

    INPUT_PORTS = {"speed": Port(float, default=0.2, description="Speed ahead in m/s.")}

    def setup(self, **kwargs):
        self.publisher = kwargs["node"].create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        print("${name} begins")

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
`;

const CONDITION = (name: string) => `import py_trees
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class ${name}(py_trees.behaviour.Behaviour):
    """Succeeds if something is nearer than the limit."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {"limit": Port(float, default=1.0, description="How near counts, in m.")}

    def setup(self, **kwargs):
        self.scan = None
        self.subscription = kwargs["node"].create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan):
        self.scan = scan

    def update(self):
        if self.scan is not None and min(self.scan.ranges) < get_input(self, "limit"):
            return py_trees.common.Status.SUCCESS
        return py_trees.common.Status.FAILURE
`;

const SERVICE = (name: string) => `import py_trees
from std_srvs.srv import Trigger


class ${name}(py_trees.behaviour.Behaviour):
    """Calls a ROS service and waits for its answer."""

    def setup(self, **kwargs):
        self.client = kwargs["node"].create_client(Trigger, "/trigger")
        self.call = None

    def initialise(self):
        self.call = None

    def update(self):
        if self.call is None:
            if not self.client.service_is_ready():
                return py_trees.common.Status.RUNNING
            self.call = self.client.call_async(Trigger.Request())
        if not self.call.done():
            return py_trees.common.Status.RUNNING
        answer = self.call.result()
        return py_trees.common.Status.SUCCESS if answer.success else py_trees.common.Status.FAILURE

    def terminate(self, new_status):
        if self.call is not None and not self.call.done():
            self.call.cancel()
`;

const TEMPLATES: Record<ActionTemplate, (name: string) => string> = {
  action: ACTION,
  condition: CONDITION,
  service: SERVICE,
};

export function actionSource(name: string, template: ActionTemplate): string {
  return TEMPLATES[template](name);
}
