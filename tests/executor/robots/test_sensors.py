"""The sensors of a robot's document."""

from __future__ import annotations

import math
from typing import Any

import pytest
from pydantic import ValidationError

from executor.robots.sensors import TURN, Camera, Lidar


def lidar(**changes: Any) -> Lidar:
    return Lidar(**({"kind": "lidar", "link": "base"} | changes))


def test_a_full_circle_begins_ahead_and_others_at_the_right() -> None:
    assert lidar(rays=4).angle_increment == pytest.approx(TURN / 4)
    assert lidar().angle_min == 0.0
    half = lidar(rays=3, fov=math.pi)
    assert (half.angle_min, half.angle_increment) == pytest.approx((-math.pi / 2, math.pi / 2))


@pytest.mark.parametrize(
    "wrong", [{"range_min": 9.0}, {"rays": 0}, {"topic": "scan"}, {"colour": "red"}, {"fov": 7}]
)
def test_what_makes_no_sense_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        lidar(**wrong)


def test_a_camera_measures_depth_only_if_it_is_asked_to() -> None:
    assert Camera(kind="camera", link="base").depth_topic is None
