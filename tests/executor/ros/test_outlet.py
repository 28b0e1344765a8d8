"""The outlet of the world keeps the order of messages, and a subscriber never blocks it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
import pytest

from executor.manager.manager import free_domain_id
from executor.ros.environment import ros_environment
from executor.supervision.channel import Channel, socket_pair

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

ROOT = Path(__file__).parents[3]
FREEZES = 6
SPEED = 5.0
LISTENER = """
import rclpy
from sensor_msgs.msg import Image, LaserScan
rclpy.init()
node = rclpy.create_node("listener")
node.create_subscription(Image, "/camera/image_raw", lambda _: None, 10)
node.create_subscription(LaserScan, "/scan", lambda _: print("scan", flush=True), 10)
rclpy.spin(node)
"""


def until(condition: Callable[[], bool], limit_s: float = 20.0) -> None:
    end_s = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(0.005)


def test_what_is_sent_ends_with_its_last_value_so_that_rosbags_reads_it() -> None:
    from rosbags.typesys import Stores, get_typestore

    from executor.ros.messages import joint_state
    from executor.ros.outlet import Outlet

    types = get_typestore(Stores.ROS2_JAZZY)
    sent: list[bytes] = []
    outlet = Outlet(lambda _, data: sent.append(data))

    def has(count: int) -> bool:
        return len(sent) == count

    try:
        for count in range(1, 5):
            names = [f"joint{'_' * number}" for number in range(count)]
            outlet.publish("publisher", joint_state(dict.fromkeys(names, (1.0, 2.0)), 0.5))
            until(partial(has, count))
            read: Any = types.deserialize_cdr(sent[-1], "sensor_msgs/msg/JointState")
            assert (read.name, list(read.velocity), list(read.effort)) == (names, [2.0] * count, [])
            assert bytes(types.serialize_cdr(read, "sensor_msgs/msg/JointState")) == sent[-1]
    finally:
        outlet.close()


def test_a_message_arrives_as_rclpy_would_send_it(context: Context) -> None:
    from rclpy.node import Node
    from std_msgs.msg import String

    from executor.ros.node import take
    from executor.ros.outlet import Outlet, Piped

    node = Node("outlet_test", context=context)
    subscription = node.create_subscription(String, "/outlet_test", print, 10)
    outlet = Outlet()
    publisher = Piped(node.create_publisher(String, "/outlet_test", 10), outlet)
    assert publisher.get_subscription_count() == 1
    message = String(data="one two")
    publisher.publish(message)
    message.data = "changed afterwards"
    publisher.publish(message)
    heard: list[str] = []

    def hear() -> bool:
        taken = take(subscription)
        heard.extend([] if taken is None else [taken.data])
        return len(heard) == 2

    until(hear)
    assert heard == ["one two", "changed afterwards"]
    outlet.close()
    node.destroy_node()


def test_publishing_does_not_block_and_the_newest_message_is_kept() -> None:
    from executor.ros.outlet import DEPTH, Outlet

    may_send, sent = threading.Event(), []

    def send(publisher: Any, data: bytes) -> None:
        may_send.wait()
        sent.append((publisher, data))

    outlet = Outlet(send)
    for number in range(50):
        outlet.put("pictures", b"%d" % number)
        outlet.flush()
    outlet.put("clock", b"now")
    assert sent == []
    may_send.set()
    until(lambda: len(sent) == DEPTH + 2)
    outlet.close()
    # The first message was being sent already; then the last few of that topic, then the other topic.
    assert [data for publisher, data in sent if publisher == "pictures"] == [
        b"0",
        *(b"%d" % number for number in range(50 - DEPTH, 50)),
    ]
    assert sent[-1] == ("clock", b"now")
    assert outlet.left_out == 49 - DEPTH


def test_a_flush_lets_all_out_while_nothing_is_held_up() -> None:
    from executor.ros.outlet import Outlet

    sent: list[bytes] = []
    outlet = Outlet(lambda _, data: sent.append(data))
    outlet.put("a", b"1")
    until(lambda: bool(sent))
    for number in range(5):
        outlet.put("a", b"%d" % number)
    outlet.flush()
    until(lambda: len(sent) == 6)
    outlet.close()


@pytest.mark.simulation
@pytest.mark.timeout(240)
def test_a_frozen_subscriber_does_not_hold_up_the_world() -> None:
    """It is stopped at random moments: at some of them it holds the lock of its shared memory."""
    domain_id = free_domain_id()
    environment = {**os.environ, **ros_environment(domain_id), "PYTHONPATH": str(ROOT)}
    ours, theirs = socket_pair()
    command = [sys.executable, "-m", "executor.world.process", "--channel-fd", str(theirs.fileno())]
    world = subprocess.Popen(command, pass_fds=[theirs.fileno()], env=environment)
    theirs.close()
    channel: Channel[Any, Any] = Channel(ours.detach(), msgspec.msgpack.decode)
    listener = subprocess.Popen(
        [sys.executable, "-c", LISTENER], env=environment, stdout=subprocess.PIPE, text=True
    )
    try:
        channel.send(
            {"type": "start", "universe": "walled_room", "seed": 1, "speed": SPEED, "domain_id": domain_id}
        )
        channel.send({"type": "resume"})
        assert listener.stdout is not None
        late = 0
        for number in range(FREEZES):
            for _ in range(4 + number):
                assert listener.stdout.readline() == "scan\n"
            listener.send_signal(signal.SIGSTOP)
            asked_s = []
            for _ in range(12):
                channel.send({"type": "move_body", "id": "?", "pose": [0] * 6, "request": "r"})
                begun_s = time.monotonic()
                answered(channel)
                asked_s.append(time.monotonic() - begun_s)
                # The spread is the test: the world publishes several times between requests.
                time.sleep(0.1 / SPEED)
            # A blocked world would take two seconds and more; a busy machine may cause one late answer.
            late += max(asked_s) > 1.5
            listener.send_signal(signal.SIGCONT)
        assert late <= 1
    finally:
        listener.kill()
        listener.communicate()
        channel.send({"type": "stop"})
        world.wait(30)
        channel.close()
    assert world.returncode == 0


def answered(channel: Channel[Any, Any]) -> None:
    while True:
        message = channel.receive(20)
        assert message is not None
        if message.get("request") == "r":
            return
