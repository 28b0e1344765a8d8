"""The gateway of a sealed run: real topics stand for those of the world."""

import subprocess
import sys
from pathlib import Path

from executor.evaluation.sealed.gateway import Gateway

ROOT = Path(__file__).parents[4]
CODE = f"""
from executor.ros.environment import use_lockstep_environment
use_lockstep_environment()
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.node import Node
from rclpy.serialization import serialize_message
from std_msgs.msg import String
from {Gateway.__module__} import Gateway
from executor.evaluation.sealed.link import Sent, Topic
from executor.ros.default_context import DefaultContext
from executor.ros.shared_topics import share_commands
from executor.ros.spin import DrainingExecutor

context = DefaultContext(simulated=True).context
twists = ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")
said = Topic("/said", ("std_msgs/msg/String",), 10)
gateway = Gateway(context, [said], [Topic("/cmd_vel", twists, 10), Topic("/other/cmd_vel", twists, 10)])
share_commands(gateway, context)
node, heard = Node("application", context=context), []
executor = DrainingExecutor(context=context)
executor.add_node(node)
assert gateway.listeners() == [0]
node.create_subscription(String, "/said", lambda message: heard.append(message.data), 10)
assert gateway.listeners() == [1]
gateway.publish([Sent(0, serialize_message(String(data=str(n)))) for n in range(3)])
executor.drain()
assert heard == ["0", "1", "2"]
node.create_publisher(Twist, "/other/cmd_vel", 10).publish(Twist())
assert [(each.topic, each.type) for each in gateway.heard()] == [("/other/cmd_vel", twists[0])]
node.create_publisher(TwistStamped, "/cmd_vel", 10).publish(TwistStamped())
assert [(each.topic, each.type) for each in gateway.heard()] == [("/cmd_vel", twists[1])]
assert gateway.heard() == []
assert gateway.navigation_in_use() == ""
from nav_msgs.msg import OccupancyGrid
node.create_subscription(OccupancyGrid, "/map", lambda _: None, 1)
assert gateway.navigation_in_use() == "/map"
gateway.close()
print("done")
"""


def test_the_gateway_publishes_hears_and_makes_way():
    done = subprocess.run(
        [sys.executable, "-c", CODE], cwd=ROOT, check=False, capture_output=True, text=True, timeout=120
    )
    assert done.stdout == "done\n", done.stderr
