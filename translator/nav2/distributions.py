"""The ROS distributions of Nav2, and what a node or a port of one is called in another."""

from __future__ import annotations

from typing import Final, Literal

Distribution = Literal["humble", "jazzy", "kilted", "lyrical"]

DISTRIBUTIONS: Final[tuple[Distribution, ...]] = ("humble", "jazzy", "kilted", "lyrical")
"""From the oldest to the newest."""
NEWEST: Final[Distribution] = "lyrical"
DEFAULT: Final[Distribution] = "jazzy"
"""That of new projects; sessions run on its rclpy."""
NEW_NODES: Final = {"IsPathValid": "ValidatePath", "IsStopped": "CheckStopStatus"}
"""Old name and new name of a node. Nav2 calls them actions since it renamed them."""
NEW_PORTS: Final = {
    ("TruncatePathLocal", "robot_frame"): "robot_base_frame",
    ("ComputeAndTrackRoute", "execution_time"): "execution_duration",
}
"""Old name and new name of a port, by type of node."""
_OLD_NODES: Final = {new: old for old, new in NEW_NODES.items()}
_OLD_PORTS: Final = {(type_, new): old for (type_, old), new in NEW_PORTS.items()}


def titled(name: str) -> str:
    """Returns a distribution as its users write it."""
    return name.capitalize()


def new_node(type_: str) -> str:
    """Returns the newest name of a node."""
    return NEW_NODES.get(type_, type_)


def node_names(type_: str) -> tuple[str, ...]:
    """Returns all names that a node has had, this one first."""
    other = NEW_NODES.get(type_) or _OLD_NODES.get(type_)
    return (type_,) if other is None else (type_, other)


def new_port(type_: str, port: str) -> str:
    """Returns the newest name of a port of a node."""
    return NEW_PORTS.get((new_node(type_), port), port)


def port_names(type_: str, port: str) -> tuple[str, ...]:
    """Returns all names that a port of a node has had, this one first."""
    place = (new_node(type_), port)
    other = NEW_PORTS.get(place) or _OLD_PORTS.get(place)
    return (port,) if other is None else (port, other)
