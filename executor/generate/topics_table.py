"""Writes the topics of the built-in robots and universes down: `python -m executor.generate.topics_table`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from executor.navigation.node import ACTIONS, MAP_TOPIC, SERVICES
from executor.robots import load_robot, robot_ids
from executor.robots.sensors import Battery, Bumper, Camera, Imu, Lidar
from executor.universes.loader import BUILTIN_IDS, load_builtin
from executor.universes.model import RobotPlace
from translator.world_topics import TABLE

if TYPE_CHECKING:
    from pydantic import BaseModel

_KEPT: Final = ("kind", "name", "topic", "info_topic", "aliases", "depth_topic", "depth_info_topic")
_ENGINE: Final = (
    ("/clock", "rosgraph_msgs/msg/Clock"),
    ("/tf", "tf2_msgs/msg/TFMessage"),
    ("/tf_static", "tf2_msgs/msg/TFMessage"),
    ("/rosout", "rcl_interfaces/msg/Log"),
    ("/parameter_events", "rcl_interfaces/msg/ParameterEvent"),
    (MAP_TOPIC, "nav_msgs/msg/OccupancyGrid"),
    ("/plan", "nav_msgs/msg/Path"),
)


def table() -> dict[str, Any]:
    """Returns the table of `translator.world_topics`."""
    kinds: dict[str, type[BaseModel]] = {
        "lidar": Lidar,
        "camera": Camera,
        "imu": Imu,
        "bumper": Bumper,
        "battery": Battery,
    }
    return {
        "engine": [list(row) for row in _ENGINE],
        "served": sorted({*ACTIONS, *SERVICES}),
        "place": _place(RobotPlace()),
        "sensors": {
            kind: {
                key: field.get_default()
                for key, field in model.model_fields.items()
                if key in _KEPT and not field.is_required()
            }
            for kind, model in kinds.items()
        },
        "robots": {robot: _sensors(robot) for robot in robot_ids()},
        "universes": {name: [_place(each) for each in load_builtin(name).robots] for name in BUILTIN_IDS},
    }


def _place(place: RobotPlace) -> dict[str, Any]:
    return place.model_dump(include={"id", "model", "topics", "ground_truth"})


def _sensors(robot: str) -> list[dict[str, Any]]:
    found = load_robot(robot)
    sensors = [*found.lidars, *found.cameras, *found.imus, *found.bumpers, *found.batteries]
    rows = [each.model_dump(include=set(_KEPT)) for each in sensors]
    return rows + ([{"kind": "ground_truth"}] if found.ground_truth else [])


def text() -> str:
    """Returns the table as text."""
    return json.dumps(table(), indent=1, sort_keys=True) + "\n"


if __name__ == "__main__":
    TABLE.write_text(text(), encoding="utf-8")
