"""Another process with plain rclpy receives every published picture: the settings of Fast DDS work."""

import json
import math
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import msgspec
import pytest

from executor.ros.environment import ros_environment
from executor.supervision.channel import Channel, socket_pair
from tests.budget import count
from tests.domains import own_domain_id

ROOT = Path(__file__).parents[3]
DOMAIN_ID = own_domain_id()
PICTURES = count("camera_delivery")
# A slow speed: the test is that nothing is lost, whatever the speed of this machine. The full count needs
# an idle machine.
SPEED = 0.25 if PICTURES < 100 else 1.0


@pytest.mark.simulation
def test_no_picture_is_lost_between_processes() -> None:
    environment = {**os.environ, **ros_environment(DOMAIN_ID), "PYTHONPATH": str(ROOT)}
    ours, theirs = socket_pair()
    world = subprocess.Popen(
        [sys.executable, "-m", "executor.world.process", "--channel-fd", str(theirs.fileno())],
        pass_fds=[theirs.fileno()],
        env=environment,
    )
    theirs.close()
    channel: Channel[Any, Any] = Channel(ours.detach(), msgspec.msgpack.decode)
    listener = subprocess.Popen(
        [sys.executable, str(Path(__file__).with_name("camera_listener.py")), str(PICTURES)],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert listener.stdout is not None
        start = {"type": "start", "universe": "walled_room", "seed": 1, "speed": SPEED}
        channel.send(start | {"domain_id": DOMAIN_ID})
        wait_for(channel, "ready")
        assert json.loads(listener.stdout.readline()) == {"ready": True}
        channel.send({"type": "resume"})
        said = json.loads(listener.stdout.readline())
        share = smallest_share(channel)
    finally:
        channel.send({"type": "stop"})
        listener.communicate(timeout=30)
        world.wait(30)
        channel.close()
    stamps = said["stamps"]
    assert len(stamps) == PICTURES
    # An even slower machine draws fewer pictures, and reports that; those that it draws must arrive.
    gaps = {round((b - a) * 15) for a, b in pairwise(stamps)}
    assert gaps <= set(range(1, math.ceil(1 / share) + 1))
    assert said["scans"] > 0
    assert said["matched_s"] is not None
    assert world.returncode == 0


def smallest_share(channel: Channel[Any, Any]) -> float:
    """Returns the smallest share of their rates at which the cameras drew."""
    shares = [1.0]
    while (message := channel.receive(0)) is not None:
        if message["type"] == "sim":
            shares.append(float(str(message["camera_share"])))
    return min(shares)


def wait_for(channel: Channel, kind: str) -> dict[str, object]:
    while True:
        message = channel.receive(60)
        assert message is not None
        if message["type"] == kind:
            return message
        assert message["type"] != "error", message
