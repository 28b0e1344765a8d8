"""The topics that leaves command. A robot follows one command at a time, so two at once are a mistake."""

from __future__ import annotations

from collections import OrderedDict
from hashlib import blake2b
from typing import TYPE_CHECKING, Final

from translator.endpoints import endpoints
from translator.tree import pointer

if TYPE_CHECKING:
    from translator.action import ActionModel
    from translator.tree import Node

COMMAND_TYPES: Final = frozenset(
    (
        *("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"),
        *("ackermann_msgs/msg/AckermannDrive", "ackermann_msgs/msg/AckermannDriveStamped"),
        *("trajectory_msgs/msg/JointTrajectory", "std_msgs/msg/Float64MultiArray"),
    )
)
MOVERS: Final = frozenset(
    (
        *("AssistedTeleop", "BackUp", "DockRobot", "DriveOnHeading", "FollowObject", "FollowPath"),
        *("NavigateThroughPoses", "NavigateToPose", "Spin", "UndockRobot"),
    )
)
"""Leaves of Nav2 whose servers command the robot."""
VELOCITY: Final = "/cmd_vel"
_KEPT: Final = 4096
_read: OrderedDict[bytes, frozenset[str]] = OrderedDict()


def commanded_by(action: ActionModel) -> frozenset[str]:
    """Returns the topics that an action's Python commands; those of a source that was read are kept."""
    source = action.source
    if "create_publisher" not in source:
        return frozenset()
    key = blake2b(source.encode("utf-8", "surrogatepass"), digest_size=16).digest()
    found = _read.get(key)
    if found is None:
        found = _read[key] = frozenset(
            absolute(end.name)
            for end in endpoints(source, action.path)
            if end.kind == "publisher" and end.known and _is_command(end.name, end.type)
        )
        if len(_read) > _KEPT:
            _read.popitem(last=False)
    return found


def commanded_by_block(node: Node) -> frozenset[str]:
    """Returns the topic that a RosPublish block commands."""
    topic, type_ = node.ports.get("topic_name", ""), node.ports.get("topic_type", "")
    if node.type != "RosPublish" or not topic or pointer(topic, "topic_name") is not None:
        return frozenset()
    full = type_ if type_.count("/") != 1 else type_.replace("/", "/msg/")
    return frozenset((absolute(topic.strip()),)) if _is_command(topic, full) else frozenset()


def absolute(topic: str) -> str:
    """Returns a topic's name with its slash; the projects' nodes are in the root namespace."""
    return topic if topic.startswith("/") else f"/{topic}"


def _is_command(topic: str, type_: str) -> bool:
    return type_ in COMMAND_TYPES or "cmd" in topic.rpartition("/")[2].split("_")
