"""The topics, services and actions of a project's world: of its robots, of navigation, and of the engine.

`world_topics.json` has those of the built-in robots and universes; `make generate` writes it.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from translator.yaml_text import YamlError, read_yaml

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from translator.project import Project

__all__ = ["TABLE", "Published", "World", "world_of"]

TABLE: Final = Path(__file__).with_name("world_topics.json")
_IMAGE: Final = "sensor_msgs/msg/Image"
_INFO: Final = "sensor_msgs/msg/CameraInfo"
_TYPES: Final = {
    "lidar": "sensor_msgs/msg/LaserScan",
    "camera": _IMAGE,
    "imu": "sensor_msgs/msg/Imu",
    "bumper": "std_msgs/msg/Bool",
    "battery": "sensor_msgs/msg/BatteryState",
}
_ZONES: Final = ("left", "center", "right")
_ODOMETRY: Final = "nav_msgs/msg/Odometry"


@dataclass(frozen=True, slots=True)
class Published:
    """A topic that somebody publishes; `sensor` is what `topics:` of a universe calls it by, if it can."""

    topic: str
    type: str
    sensor: str = ""


@dataclass(frozen=True, slots=True)
class World:
    """The topics of a world, and the services and actions that it serves.

    `path` is that of the project's own universe; "" for a built-in one.
    """

    published: tuple[Published, ...]
    served: frozenset[str]
    path: str


@cache
def _table() -> dict[str, Any]:
    table: dict[str, Any] = json.loads(TABLE.read_bytes())
    return table


def world_of(project: Project) -> World | None:
    """Returns the world of a project; None if it cannot be known, as for an outside ROS graph."""
    settings = project.settings
    path = f"universes/{settings.universe}.yaml"
    places = _table()["universes"].get(settings.universe)
    if path in project.files:
        places = _places(_document(project.files[path]))
    else:
        path = ""
    if places is None:
        return None
    found = [Published(*row) for row in _table()["engine"]]
    for index, place in enumerate(places):
        sensors = _sensors(settings.robot or place["model"], project.files)
        if sensors is None:
            return None
        prefix = "" if index == 0 else f"/{place.get('id', '')}"
        for each in _of_robot(sensors, place):
            found.append(Published(prefix + each.topic, each.type, each.sensor if index == 0 else ""))
    return World(tuple(found), frozenset(_table()["served"]), path)


def _document(raw: bytes) -> dict[str, Any] | None:
    try:
        value = read_yaml(raw).value
    except YamlError:
        return None
    return value if isinstance(value, dict) else None


def _places(universe: dict[str, Any] | None) -> list[dict[str, Any]] | None:
    robots = None if universe is None else universe.get("robots", [])
    if not isinstance(robots, list) or not all(isinstance(each, dict) for each in robots):
        return None
    return [{**_table()["place"], **each} for each in robots]


def _sensors(robot: Any, files: Mapping[str, bytes]) -> list[dict[str, Any]] | None:
    if not isinstance(robot, str):
        return None
    path = f"robots/{robot}/robot.yaml"
    if path not in files:
        sensors: list[dict[str, Any]] | None = _table()["robots"].get(robot)
        return sensors
    document = _document(files[path])
    said = None if document is None else document.get("sensors", [])
    if not isinstance(said, list):
        return None
    defaults = _table()["sensors"]
    if not all(isinstance(each, dict) and isinstance(each.get("kind"), str) for each in said):
        return None
    if not all(each["kind"] in defaults for each in said):
        return None
    truth = {"kind": "ground_truth"} if document and document.get("ground_truth") is True else None
    return [{**defaults[each["kind"]], **each} for each in said] + ([truth] if truth else [])


def _of_robot(sensors: list[dict[str, Any]], place: Mapping[str, Any]) -> Iterator[Published]:
    renamed = place.get("topics") if isinstance(place.get("topics"), dict) else {}
    yield Published("/odom", _ODOMETRY)
    yield Published("/joint_states", "sensor_msgs/msg/JointState")
    yield Published("/robot_description", "std_msgs/msg/String")
    if place.get("ground_truth") is True or any(each["kind"] == "ground_truth" for each in sensors):
        yield Published("/ground_truth/odom", _ODOMETRY)
    for each in sensors:
        name, topic, kind = each.get("name"), each.get("topic"), _TYPES.get(each["kind"])
        topic = (renamed or {}).get(name, topic) if isinstance(name, str) else None
        if kind is None or not isinstance(name, str) or not isinstance(topic, str):
            continue  # the check of the file itself reports what is written wrongly
        yield Published(topic, kind, name)
        if each["kind"] == "bumper":
            yield from (Published(f"{topic}/{zone}", kind) for zone in _ZONES)
        aliases = each.get("aliases")
        more = [(alias, kind) for alias in aliases] if isinstance(aliases, list) else []
        more += [
            (each.get(key), type_)
            for key, type_ in (("info_topic", _INFO), ("depth_topic", _IMAGE), ("depth_info_topic", _INFO))
        ]
        yield from (Published(other, type_) for other, type_ in more if isinstance(other, str) and other)
