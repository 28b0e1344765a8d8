"""Transforms between frames, without ROS."""

from __future__ import annotations

import math
from types import SimpleNamespace as Thing
from typing import Any

import pytest

from tree_gardener.ros_nodes.frames import Frames


def message(parent: str, child: str, x: float, yaw: float, stamp_s: int = 1) -> Any:
    turn = Thing(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))
    header = Thing(frame_id=parent, stamp=Thing(sec=stamp_s, nanosec=0))
    move = Thing(translation=Thing(x=x, y=0.0, z=0.0), rotation=turn)
    return Thing(transforms=[Thing(header=header, child_frame_id=child, transform=move)])


@pytest.fixture
def frames() -> Frames:
    made = Frames()
    made.received(message("map", "odom", 1.0, math.pi / 2, stamp_s=5))
    made.received(message("odom", "base", 2.0, 0.0, stamp_s=7))
    made.received(message("/base", "/lidar", 0.5, 0.0), is_fixed=True)
    return made


def test_a_chain_is_composed(frames: Frames) -> None:
    found = frames.lookup("map", "lidar")
    assert found is not None
    assert found.translation == pytest.approx((1.0, 2.5, 0.0))
    assert found.stamp_s == 5.0  # the oldest one that is not static


def test_the_other_direction_is_the_inverse(frames: Frames) -> None:
    there, back = frames.lookup("map", "base"), frames.lookup("base", "map")
    assert there is not None
    assert back is not None
    assert there.then(back).translation == pytest.approx((0.0, 0.0, 0.0))
    assert back.translation == pytest.approx((-2.0, 1.0, 0.0))


def test_siblings_meet_at_their_parent(frames: Frames) -> None:
    frames.received(message("base", "camera", -0.5, 0.0))
    found = frames.lookup("lidar", "camera")
    assert found is not None
    assert found.translation == pytest.approx((-1.0, 0.0, 0.0))


def test_frames_that_nothing_connects_have_no_transform(frames: Frames) -> None:
    frames.received(message("other", "arm", 1.0, 0.0))
    assert frames.lookup("map", "arm") is None
    assert frames.has("other")
    assert not frames.has("nobody")


def test_a_circle_ends() -> None:
    frames = Frames()
    frames.received(message("a", "b", 1.0, 0.0))
    frames.received(message("b", "a", 1.0, 0.0))
    assert frames.lookup("a", "z") is None
