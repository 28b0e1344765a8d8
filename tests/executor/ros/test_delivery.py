"""Another process with plain rclpy hears every picture that is published: the settings of Fast DDS work."""

import json
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from executor.ros.environment import ros_environment
from executor.supervision.channel import Channel, socket_pair

ROOT = Path(__file__).parents[3]
DOMAIN_ID = 222
PICTURES = 45


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
    channel = Channel(ours.detach())
    listener = subprocess.Popen(
        [sys.executable, str(Path(__file__).with_name("camera_listener.py")), str(PICTURES)],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert listener.stdout is not None
        # A slow speed: what is tested is that nothing is lost, not how fast this machine is today.
        start = {"type": "start", "universe": "walled_room", "seed": 1, "speed": 0.25, "domain_id": DOMAIN_ID}
        channel.send(start)
        wait_for(channel, "ready")
        assert json.loads(listener.stdout.readline()) == {"ready": True}
        channel.send({"type": "resume"})
        said = json.loads(listener.stdout.readline())
    finally:
        channel.send({"type": "stop"})
        listener.communicate(timeout=30)
        world.wait(30)
        channel.close()
    stamps = said["stamps"]
    assert len(stamps) == PICTURES
    assert [round((b - a) * 15) for a, b in pairwise(stamps)] == [1] * (PICTURES - 1)
    assert said["scans"] > 0
    assert said["matched_s"] is not None
    assert world.returncode == 0


def wait_for(channel: Channel, kind: str) -> dict[str, object]:
    while True:
        message = channel.receive(60)
        assert message is not None
        if message["type"] == kind:
            return message
        assert message["type"] != "error", message
