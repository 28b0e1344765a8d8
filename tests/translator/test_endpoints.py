"""Topics, services, actions and parameters are read from the source of an action."""

from __future__ import annotations

import textwrap

import pytest

from translator.endpoints import endpoints


def found(source):
    return [
        (item.name, item.kind, item.type, item.known)
        for item in endpoints(textwrap.dedent(source), "actions/A.py")
    ]


@pytest.mark.parametrize(
    ("imports", "type_"),
    [
        ("from geometry_msgs.msg import Twist", "Twist"),
        ("from geometry_msgs.msg import Twist as T", "T"),
        ("from geometry_msgs.msg import *", "Twist"),
        ("import geometry_msgs.msg", "geometry_msgs.msg.Twist"),
        ("import geometry_msgs.msg as gm", "gm.Twist"),
        ("import geometry_msgs", "geometry_msgs.msg.Twist"),
        ("from geometry_msgs import msg", "msg.Twist"),
    ],
)
def test_types_are_followed_through_imports(imports, type_):
    source = f"{imports}\nnode.create_publisher({type_}, '/cmd_vel', 10)"
    assert found(source) == [("/cmd_vel", "publisher", "geometry_msgs/msg/Twist", True)]


def test_every_kind_of_end_is_seen_in_order_of_the_file():
    source = """
    import message_filters
    from nav2_msgs.action import NavigateToPose
    from rclpy.action import ActionClient, ActionServer
    from rclpy.wait_for_message import wait_for_message
    from sensor_msgs.msg import Image, LaserScan
    from std_srvs.srv import SetBool
    from tf2_ros import TransformBroadcaster, TransformListener

    class A:
        def setup(self, **kwargs):
            node = kwargs["node"]
            self.a = node.create_subscription(topic="scan", msg_type=LaserScan, callback=print)
            self.b = node.create_client(SetBool, "motor")
            self.c = node.create_service(SetBool, "lamp", print)
            self.d = ActionClient(node, NavigateToPose, "navigate_to_pose")
            self.e = ActionServer(node, NavigateToPose, "drive", print)
            self.f = message_filters.Subscriber(node, Image, "/camera/image_raw")
            self.g = TransformListener(buffer, node)
            self.h = TransformBroadcaster(node)
            self.i = node.declare_parameter("gain", 2.0).value
            _, self.j = wait_for_message(LaserScan, node, "/once")
    """
    scan, motor, goal = "sensor_msgs/msg/LaserScan", "std_srvs/srv/SetBool", "nav2_msgs/action/NavigateToPose"
    tf = "tf2_msgs/msg/TFMessage"
    assert found(source) == [
        ("scan", "subscription", scan, True),
        ("motor", "client", motor, True),
        ("lamp", "service", motor, True),
        ("navigate_to_pose", "action client", goal, True),
        ("drive", "action server", goal, True),
        ("/camera/image_raw", "subscription", "sensor_msgs/msg/Image", True),
        ("/tf", "subscription", tf, True),
        ("/tf_static", "subscription", tf, True),
        ("/tf", "publisher", tf, True),
        ("gain", "parameter", "2.0", True),
        ("/once", "subscription", scan, True),
    ]


@pytest.mark.parametrize(
    ("before", "name", "shown"),
    [
        ("T = '/a'", "T", "/a"),
        ("T = '/a'", "T + '/b'", "/a/b"),
        ("T = '/a'", "f'{T}/b'", "/a/b"),
        ("class A:\n    T = '/a'", "self.T", "/a"),
        ("class A:\n    T = '/a'", "A.T", "/a"),
        ("self.t = '/a'", "self.t", "/a"),
    ],
)
def test_constants_are_names(before, name, shown):
    assert found(f"{before}\nnode.create_publisher(X, {name}, 1)") == [(shown, "publisher", "", True)]


@pytest.mark.parametrize(
    ("before", "name"),
    [
        ("", "self.ports['topic']"),
        ("T = '/a'\nT = '/b'", "T"),
        ("T = '/a'\nT += '/b'", "T"),
        ("T = 3", "T"),
        ("for T in names: pass", "T"),
        ("T = '/a'\ndef f(T): pass", "T"),
        ("T = '/a'", "f'{T!r}'"),
        ("class A:\n    t = '/a'\nself.t = other", "self.t"),
        ("", "get_input(self, 'topic')"),
    ],
)
def test_what_is_made_at_run_time_is_given_as_its_expression(before, name):
    assert found(f"{before}\nnode.create_publisher(X, {name}, 1)") == [(name, "publisher", "", False)]


@pytest.mark.parametrize(
    "source", ["def (", "x" * 10 + "\0", "create_publisher()", "node.create_publisher(*args)", "(" * 5000]
)
def test_nothing_is_made_of_what_says_nothing(source):
    assert found(source) == []
