"""Poses and lists of poses from ports: messages, or texts."""

import math
from typing import Any, Final

from tree_gardener.errors import PortError
from tree_gardener.nav2.geometry import copied
from tree_gardener.nav2.topics import message_class

NAV2_PARTS: Final = 9
SHORT_PARTS: Final = 3
FRAME: Final = "map"


def pose_from(value: Any) -> Any:
    """Returns a stamped pose from a message or a text.

    A text is Nav2's ``stamp;frame;x;y;z;qx;qy;qz;qw``, with the stamp in ns, or ``x;y;yaw`` in the map.

    Raises:
        PortError: it is neither.
    """
    if not isinstance(value, str):
        return value
    parts = [part.strip() for part in value.split(";")]
    message = message_class("geometry_msgs", "PoseStamped")()
    try:
        if len(parts) == NAV2_PARTS:
            _fill(message, parts)
            return message
        x, y, yaw = (float(part) for part in parts)
    except ValueError:
        raise PortError(
            f"'{value}' is no pose; write x;y;yaw, or stamp;frame;x;y;z;qx;qy;qz;qw as in Nav2"
        ) from None
    message.header.frame_id = FRAME
    message.pose.position.x, message.pose.position.y = x, y
    message.pose.orientation.z, message.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def poses_from(value: Any) -> list[Any]:
    """Returns the poses of a Goals message, a list, or a text with poses between ``|``."""
    if isinstance(value, str):
        return [pose_from(part) for part in value.split("|") if part.strip()]
    return [pose_from(each) for each in getattr(value, "goals", value)]


def regrouped(goals: Any, left: list[Any]) -> Any:
    """Returns poses in the form of `goals`: a Goals message, as since Kilted, or a list, as before."""
    return copied(goals, goals=left) if hasattr(goals, "goals") else left


def duration(seconds: float) -> Any:
    """Returns seconds as a message."""
    whole = math.floor(seconds)
    nanoseconds = min(round((seconds - whole) * 1e9), 999_999_999)
    return message_class("builtin_interfaces", "Duration")(sec=whole, nanosec=nanoseconds)


def _fill(message: Any, parts: list[str]) -> None:
    stamp = int(parts[0])
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 1_000_000_000)
    message.header.frame_id = parts[1]
    place, turn = message.pose.position, message.pose.orientation
    place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w = (float(part) for part in parts[2:])
