"""Sensors of Gazebo become those of `robot.yaml`, or are left out with their line."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from pydantic import TypeAdapter

from executor.robots.importing.devices import find_sensors
from executor.robots.sensors import Sensor
from tests.executor.robots.importing.carts import BODY, read

if TYPE_CHECKING:
    from executor.robots.importing.report import Report

LIDAR = """<sensor name="front laser" type="{type}"><update_rate>{rate}</update_rate>{topic}
<{tag}><scan><horizontal><samples>720</samples><min_angle>{low}</min_angle><max_angle>{high}</max_angle>
</horizontal><vertical><samples>{rows}</samples></vertical></scan>
<range><min>0.1</min><max>12</max></range><noise><stddev>0.01</stddev></noise></{tag}></sensor>"""


def lidar(**values: Any) -> str:
    given = {"type": "gpu_lidar", "tag": "lidar", "rate": 10, "topic": "", "low": -1, "high": 1, "rows": 1}
    return LIDAR.format(**(given | values))


def sensors(*inside: str, link: str = "base_link") -> tuple[list[dict[str, Any]], Report]:
    urdf, root, report = read([BODY, *(f'<gazebo reference="{link}">{each}</gazebo>' for each in inside)])
    found = find_sensors(root, urdf.links, report)
    for each in found:
        TypeAdapter(Sensor).validate_python(each)
    return found, report


@pytest.mark.parametrize(
    ("kind", "tag"), [("ray", "ray"), ("gpu_ray", "ray"), ("lidar", "lidar"), ("gpu_lidar", "lidar")]
)
def test_a_lidar_has_its_rays_range_and_noise(kind: str, tag: str) -> None:
    [made], report = sensors(lidar(type=kind, tag=tag, topic="<topic>my/scan</topic>"))
    assert made == {
        "name": "front_laser", "kind": "lidar", "link": "base_link", "rays": 720, "fov": 2, "range_min": 0.1,
        "range_max": 12, "noise_m": 0.01, "topic": "/my/scan", "rate_hz": 10,
    }  # fmt: skip
    assert report.assumed == []
    assert "lidar front_laser at base_link: /my/scan, 10 Hz" in report.taken[0]


def test_what_differs_of_a_lidar_is_said() -> None:
    [made], report = sensors(lidar(rate=200, low=0, high=1.5))
    assert (made["rate_hz"], made["fov"]) == (60, 1.5)
    assert ["200 Hz are more than the 60 Hz" in text for text in report.assumed] == [False, True]
    assert "looks straight ahead" in report.assumed[0]
    [made], report = sensors(lidar(low=-3.14, high=3.14))
    assert made["fov"] == pytest.approx(2 * math.pi, abs=1e-5)
    found, report = sensors(lidar(rows=16))
    assert found == []
    assert "3D LIDAR" in report.left_out[0]


CAMERA = """<sensor name="eye" type="{type}"><camera>
<horizontal_fov>1.2</horizontal_fov><image><width>320</width>
<height>240</height></image><clip><near>0.1</near><far>30</far></clip></camera>
<plugin filename="x"><ros><remapping>~/out:=ignored</remapping></ros></plugin></sensor>"""


def test_cameras_have_their_size_and_two_have_two_topics() -> None:
    (one, two), _ = sensors(
        CAMERA.format(type="camera"), CAMERA.format(type="rgbd_camera").replace("eye", "eye")
    )
    assert (one["width"], one["height"], one["fov"], one["near"], one["far"]) == (320, 240, 1.2, 0.1, 30)
    assert "depth_topic" not in one
    assert two["depth_topic"] == "/camera/depth/image_raw"
    assert (one["name"], two["name"]) == ("eye", "eye_2")
    assert len({one["topic"], two["topic"], one["info_topic"], two["info_topic"]}) == 4


def test_an_imu_and_a_bumper_are_taken() -> None:
    noise = "<imu><angular_velocity><x><noise><stddev>0.02</stddev></noise></x></angular_velocity></imu>"
    (imu, bumper), _ = sensors(f'<sensor type="imu">{noise}</sensor>', '<sensor name="b" type="contact"/>')
    assert (imu["kind"], imu["name"], imu["rate_noise"], imu["rate_hz"]) == ("imu", "imu", 0.02, 30)
    assert (bumper["kind"], bumper["topic"]) == ("bumper", "/bumper")


@pytest.mark.parametrize("kind", ["gps", "navsat", "sonar", "magnetometer", "force_torque", ""])
def test_other_kinds_are_left_out_with_their_line(kind: str) -> None:
    found, report = sensors(f'<sensor name="s" type="{kind}"/>')
    assert found == []
    [line] = report.left_out
    assert line.startswith("cart.urdf:4: the sensor 's'")
    found, report = sensors('<sensor name="s" type="imu"/>', link="ghost")
    assert (found, len(report.left_out)) == ([], 1)
