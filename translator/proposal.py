"""Proposes a universe and a robot for the actions of an imported project, by the topics that they use."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from translator.action_ports import last_name
from translator.python_source import parse

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

__all__ = ["Proposal", "TopicUse", "propose", "topics_used"]

_CALLS: Final[dict[str, tuple[str, ...]]] = {
    "create_subscription": ("msg_type", "topic"),
    "create_publisher": ("msg_type", "topic"),
    "Subscriber": ("node", "msg_type", "topic"),  # of message_filters
}
_CAMERA: Final = frozenset({"Image", "CompressedImage", "CameraInfo", "PointCloud2"})
_NEARNESS: Final = frozenset({"LaserScan", "Range", "PointCloud"})
_DRIVING: Final = frozenset({"Twist", "TwistStamped", "Odometry", "Imu"})
_MAPS: Final = frozenset({"OccupancyGrid", "Path", "NavigateToPose"})
_NEAR_TOPICS: Final = ("/scan", "/bumper")
_PAN_TOPIC: Final = "/camera/pan/command"
_OF_F1: Final = {"/cam_f1_left/image_raw": "circuit", "/f1/laser/scan": "circuit_obstacles"}
"""The topics that only the F1 has, each with its circuit."""


@dataclass(frozen=True, slots=True)
class TopicUse:
    """A topic that an action names, with the message type if its source states it."""

    topic: str
    type: str
    is_published: bool


@dataclass(frozen=True, slots=True)
class Proposal:
    """A universe; a robot if that of the universe does not suit; and the reason."""

    universe: str
    robot: str | None = None
    reason: str = ""


def topics_used(source: str) -> list[TopicUse]:
    """Returns the topics that an action publishes or subscribes to; none if it cannot be parsed."""
    try:
        module = parse(source, "proposal.py")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    return list(_uses(module))


def propose(actions: Mapping[str, bytes], *, hints: Iterable[str] = ()) -> Proposal | None:
    """Returns the proposal, or None if the topics of the actions do not determine one.

    Args:
        actions: the sources of the actions, by path.
        hints: the names of the project and of its trees, which distinguish universes for cameras.
    """
    texts = {path: raw.decode("utf-8", "replace") for path, raw in sorted(actions.items())}
    uses = [use for text in texts.values() for use in topics_used(text)]
    robot = "lookout" if any(use.topic == _PAN_TOPIC for use in uses) else None
    heard = [use for use in uses if not use.is_published]
    words = " ".join((*hints, *texts)).lower()
    for universe, chosen in (
        *((_OF_F1[use.topic], [use]) for use in heard if use.topic in _OF_F1),
        ("line" if "line" in words else "person_in_green", [use for use in heard if use.type in _CAMERA]),
        (
            "walled_room",
            [use for use in heard if use.type in _NEARNESS or use.topic.startswith(_NEAR_TOPICS)],
        ),
        ("warehouse", [use for use in heard if use.type in _MAPS]),
        ("walled_room", [use for use in uses if use.type in _DRIVING]),
    ):
        if chosen:
            return Proposal(universe, robot, ", ".join(sorted({use.topic for use in chosen})))
    return None


def _uses(module: ast.Module) -> Iterator[TopicUse]:
    texts = _named_texts(module)
    for node in ast.walk(module):
        if not isinstance(node, ast.Call) or (name := last_name(node.func)) not in _CALLS:
            continue
        given = dict(zip(_CALLS[name], node.args, strict=False))
        given |= {keyword.arg: keyword.value for keyword in node.keywords if keyword.arg}
        topic, type_ = _text(given.get("topic"), texts), given.get("msg_type")
        if topic:
            type_name = last_name(type_) if type_ is not None else ""
            yield TopicUse(f"/{topic.lstrip('~/')}", type_name, name == "create_publisher")


def _named_texts(module: ast.Module) -> dict[str, str]:
    """Returns the constant texts of names of the module or of a class, such as `TOPIC = "/scan"`."""
    return {
        last_name(target): node.value.value
        for node in ast.walk(module)
        if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
        for target in node.targets
    }


def _text(node: ast.expr | None, texts: Mapping[str, str]) -> str:
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else ""
    return "" if node is None else texts.get(last_name(node), "")
