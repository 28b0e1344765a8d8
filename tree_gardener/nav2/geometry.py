"""Distances in the plane between poses and along paths, as in ``nav2_util/geometry_utils.hpp``.

A pose is a ``geometry_msgs/PoseStamped``, or anything of its shape.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any


def distance(first: Any, second: Any) -> float:
    """Returns the distance between two stamped poses in the plane."""
    a, b = first.pose.position, second.pose.position
    return math.hypot(a.x - b.x, a.y - b.y)


def path_length(poses: Sequence[Any], start: int = 0) -> float:
    """Returns the length of a path from the pose with index `start` on."""
    return sum(distance(poses[i], poses[i + 1]) for i in range(start, len(poses) - 1))


def first_beyond(poses: Sequence[Any], begin: int, way: float) -> int:
    """Returns the index of the first pose further along the path than `way`; if none, the number of poses."""
    length = 0.0
    for index in range(begin, len(poses) - 1):
        length += distance(poses[index], poses[index + 1])
        if length > way:
            return index + 1
    return len(poses)


def nearest(begin: int, end: int, measure: Callable[[int], float]) -> int:
    """Returns the index in ``begin..end-1`` with the smallest measure; if there are several, the last one."""
    return min(range(begin, end), key=lambda index: (measure(index), -index), default=end)


def turn_between(first: Any, second: Any) -> float:
    """Returns the shortest angle between two orientations, in radians."""
    dot = first.x * second.x + first.y * second.y + first.z * second.z + first.w * second.w
    lengths = math.hypot(first.x, first.y, first.z, first.w) * math.hypot(
        second.x, second.y, second.z, second.w
    )
    return 2.0 * math.acos(min(1.0, abs(dot) / lengths)) if lengths else 0.0


def copied(message: Any, **changes: Any) -> Any:
    """Returns a message of the same class and with the same fields, except for the changes."""
    fields = message.get_fields_and_field_types()
    return type(message)(**{name: changes.get(name, getattr(message, name)) for name in fields})
