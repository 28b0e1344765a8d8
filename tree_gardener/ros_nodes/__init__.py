"""ROS as nodes without Python: actions, services, topics, parameters and transforms.

`RosAction`, `RosService`, `RosPublish`, `RosSubscribe`, `RosParam` and `TfLookup` are in `catalog.json`. The
fields of a goal, request or message are ports: ``goal__pose__pose__position__x``. They follow
BehaviorTree.ROS2. `RosActionNode` and `RosServiceNode` are the classes for nodes with ports of their own.

rclpy and the packages of interfaces are imported when a node is set up: a tree loads without ROS.
"""

from collections.abc import Mapping
from typing import Final

from tree_gardener.ros_nodes.action import RosAction
from tree_gardener.ros_nodes.parameter import RosParam
from tree_gardener.ros_nodes.publish import RosPublish
from tree_gardener.ros_nodes.service import RosService
from tree_gardener.ros_nodes.subscribe import RosSubscribe
from tree_gardener.ros_nodes.transform import TfLookup

NODES: Final[Mapping[str, type]] = {
    cls.__name__: cls for cls in (RosAction, RosService, RosPublish, RosSubscribe, RosParam, TfLookup)
}
