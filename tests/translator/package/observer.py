"""A program: waits for a node and prints its topics and parameters as JSON."""

from __future__ import annotations

import json
import sys
import time

import rclpy
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.parameter import parameter_value_to_python

WAIT_S = 90.0
NAMES = {"tick_hz", "on_finish", "on_error", "use_sim_time", "text", "rate"}
OF_ROS = {"/clock", "/parameter_events", "/rosout"}


def main(full_name: str) -> None:
    """Prints what the graph says of the node, once it has opened topics of its own."""
    rclpy.init()
    me = rclpy.create_node("observer")
    namespace, _, name = full_name.rpartition("/")
    if not me.create_client(ListParameters, f"{full_name}/list_parameters").wait_for_service(WAIT_S):
        sys.exit(f"there is no {full_name}")
    end = time.monotonic() + WAIT_S
    publishes: list[str] = []
    # The node declares its parameters, then opens its topics, while we look.
    while not publishes and time.monotonic() < end:
        time.sleep(0.5)
        found = me.get_publisher_names_and_types_by_node(name, namespace or "/")
        publishes = sorted({topic for topic, _ in found} - OF_ROS)
    found = me.get_subscriber_names_and_types_by_node(name, namespace or "/")
    subscribes = sorted({topic for topic, _ in found} - OF_ROS)
    seen = {"parameters": parameters(me, full_name), "publishes": publishes, "subscribes": subscribes}
    sys.stdout.write(json.dumps(seen))


def parameters(me, full_name):
    """Returns the parameters of the node; a request for a missing one would return nothing."""
    listed = ask(me, ListParameters, f"{full_name}/list_parameters", ListParameters.Request())
    names = sorted(NAMES & set(listed.result.names))
    got = ask(me, GetParameters, f"{full_name}/get_parameters", GetParameters.Request(names=names))
    return dict(zip(names, map(parameter_value_to_python, got.values), strict=True))


def ask(me, kind, service, request):
    """The answer of a service."""
    client = me.create_client(kind, service)
    client.wait_for_service(WAIT_S)
    future = client.call_async(request)
    rclpy.spin_until_future_complete(me, future, timeout_sec=WAIT_S)
    return future.result()


main(sys.argv[1])
