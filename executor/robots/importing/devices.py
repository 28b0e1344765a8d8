"""Sensors of Gazebo as those of `robot.yaml`; kinds that we do not have are left out, with their line."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Collection

    from lxml import etree

    from executor.robots.importing.report import Report

MOST_HZ: Final = 60.0
_LIDARS: Final = frozenset({"ray", "gpu_ray", "lidar", "gpu_lidar"})
_CAMERAS: Final = frozenset({"camera", "depth", "depth_camera", "rgbd", "rgbd_camera", "multicamera"})
_DEPTH: Final = frozenset({"depth", "depth_camera", "rgbd", "rgbd_camera"})
_DEFAULTS: Final = {"lidar": "/scan", "camera": "/camera/image_raw", "imu": "/imu", "bumper": "/bumper"}


def find_sensors(root: etree._Element, links: Collection[str], report: Report) -> list[dict[str, Any]]:
    """Returns the sensors of a URDF, as `robot.yaml` has them."""
    found: list[dict[str, Any]] = []
    for gazebo in root.iterfind("gazebo"):
        for sensor in gazebo.iterfind("sensor"):
            link = gazebo.get("reference", "")
            if link not in links:
                report.leave_out(sensor, f"the sensor is at the link {link!r}, which does not exist")
                continue
            made = _sensor(sensor, link, report)
            if made is not None:
                _make_unique(made, found)
                found.append(made)
                at, rate = report.at(sensor), made["rate_hz"]
                report.taken.append(
                    f"{made['kind']} {made['name']} at {link}: {made['topic']}, {rate:g} Hz ({at})"
                )
    return found


def _sensor(sensor: etree._Element, link: str, report: Report) -> dict[str, Any] | None:
    kind = sensor.get("type", "")
    made: dict[str, Any] = {"name": _identifier(sensor.get("name", ""), kind), "kind": "", "link": link}
    pose = [word for word in (sensor.findtext("pose") or "").split() if word.strip("+-0.")]
    if pose and (kind in _LIDARS or kind in _CAMERAS):
        at = report.at(sensor)
        report.assumed.append(f"{at}: the sensor is at its link's own frame; its <pose> is not applied")
    if kind in _LIDARS:
        made["kind"] = "lidar"
        if not _lidar(sensor, made, report):
            return None
    elif kind in _CAMERAS:
        made["kind"] = "camera"
        _camera(sensor, made, kind)
    elif kind == "imu":
        made["kind"] = "imu"
        for key, path in (("rate_noise", "angular_velocity"), ("acceleration_noise", "linear_acceleration")):
            deviation = _number(sensor, f"imu/{path}/x/noise/stddev")
            if deviation:
                made[key] = deviation
    elif kind == "contact":
        made["kind"] = "bumper"
    else:
        what = "GPS" if kind in ("gps", "navsat") else kind or "without a type"
        report.leave_out(sensor, f"the sensor {sensor.get('name')!r} ({what}) is not simulated")
        return None
    made["topic"] = _topic(sensor) or _DEFAULTS[made["kind"]]
    rate = _number(sensor, "update_rate") or (30.0 if made["kind"] == "imu" else 10.0)
    if rate > MOST_HZ:
        report.assumed.append(f"{report.at(sensor)}: {rate:g} Hz are more than the {MOST_HZ:g} Hz of here")
    made["rate_hz"] = min(rate, MOST_HZ)
    return made


def _lidar(sensor: etree._Element, made: dict[str, Any], report: Report) -> bool:
    ray = next((each for tag in ("ray", "lidar") for each in sensor.iterfind(tag)), sensor)
    if (_number(ray, "scan/vertical/samples") or 1) > 1:
        report.leave_out(sensor, f"the sensor {sensor.get('name')!r} is a 3D LIDAR, which is not simulated")
        return False
    made["rays"] = max(1, min(4000, round(_number(ray, "scan/horizontal/samples") or 640)))
    low = _number(ray, "scan/horizontal/min_angle")
    high = _number(ray, "scan/horizontal/max_angle")
    if low is not None and high is not None and high - low > 0.01:
        fov = min(high - low, 2 * math.pi)
        is_whole = fov > 2 * math.pi - 0.05
        made["fov"] = round(2 * math.pi if is_whole else fov, 6)
        if not is_whole and abs(low + high) > 0.02:
            at = report.at(sensor)
            report.assumed.append(
                f"{at}: the LIDAR looks straight ahead, not from {low:.3g} to {high:.3g} rad"
            )
    near, far = (_number(ray, f"range/{key}") for key in ("min", "max"))
    if near is not None and far is not None and 0 <= near < far and math.isfinite(far):
        made |= {"range_min": near, "range_max": far}
    if noise := _number(ray, "noise/stddev"):
        made["noise_m"] = noise
    return True


def _camera(sensor: etree._Element, made: dict[str, Any], kind: str) -> None:
    camera = next(sensor.iterfind("camera"), sensor)
    for key, path in (("width", "image/width"), ("height", "image/height")):
        if (pixels := _number(camera, path)) is not None:
            made[key] = max(8, min(4096, round(pixels)))
    fov = _number(camera, "horizontal_fov")
    if fov is not None:
        made["fov"] = min(max(fov, 0.06), 2.99)
    near, far = (_number(camera, f"clip/{key}") for key in ("near", "far"))
    if near is not None and far is not None and 0 < near < far:
        made |= {"near": near, "far": far}
    if kind in _DEPTH:
        made["depth_topic"] = "/camera/depth/image_raw"
        made["depth_info_topic"] = "/camera/depth/camera_info"


def _topic(sensor: etree._Element) -> str | None:
    """Returns the topic that a sensor or its plugin names."""
    for remapping in sensor.iter("remapping"):
        name, _, to = (remapping.text or "").strip().partition(":=")
        if name.endswith(("~/out", "image_raw")) and to:
            return _as_topic(to)
    for path in ("topic", "plugin/topicName", "plugin/topic_name", "plugin/imageTopicName"):
        text = (sensor.findtext(path) or "").strip()
        if text:
            return _as_topic(text)
    return None


def _as_topic(text: str) -> str | None:
    name = re.sub(r"[^A-Za-z0-9_/]", "_", text).strip("/")
    return f"/{name}" if name else None


def _identifier(name: str, kind: str) -> str:
    made = re.sub(r"[^A-Za-z0-9_]", "_", name)[:70]
    return made if made[:1].isalpha() else f"{kind or 'sensor'}_{made}".strip("_")


def _make_unique(made: dict[str, Any], others: list[dict[str, Any]]) -> None:
    """Numbers names and topics that another sensor has already."""
    for key in ("name", "topic", "depth_topic", "depth_info_topic"):
        taken = {other.get(key) for other in others}
        value, number = made.get(key), 1
        while value is not None and made[key] in taken:
            number += 1
            made[key] = f"{value}_{number}"
    if made["kind"] == "camera":
        made["info_topic"] = made["topic"].rpartition("/")[0] + "/camera_info"
        while made["info_topic"] in {other.get("info_topic") for other in others}:
            made["info_topic"] += "_2"


def _number(element: etree._Element, path: str) -> float | None:
    try:
        value = float(element.findtext(path) or "")
    except ValueError:
        return None
    return value if math.isfinite(value) else None
