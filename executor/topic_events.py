"""Events of the panel Topics and of launch nodes: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

LaunchState = Literal["running", "ended", "failed"]
MismatchCode = Literal["type", "reliability", "durability", "qos", "unpublished", "elsewhere", "unserved"]


class TopicInfo(Struct):
    """One ROS topic: its rate over the last two seconds, and the nodes at both of its ends.

    `hz` and `bytes_per_s` are null without a measurement: images and point clouds are measured only while a
    client echoes them, and the first `list_topics` after a while starts the measurement. `types` holds all
    types of the topic; several only if a robot accepts several types on its command topic.
    """

    name: str
    type: str
    hz: float | None
    bytes_per_s: float | None
    publishers: list[str]
    subscribers: list[str]
    types: list[str]


class Topics(Struct):
    """The topics of the session's ROS graph."""

    topics: list[TopicInfo]


class TopicMessage(Struct):
    """One message of a topic that a client echoes.

    Numbers that JSON lacks (infinite, not a number) are null. Long arrays and texts are shortened: `cut`
    names them by their path (`ranges`, `pose.covariance`) with their true length. `bytes` is the size of the
    message on the wire.
    """

    topic: str
    type: str
    message: dict[str, Any]
    bytes: int = 0
    cut: dict[str, int] = {}


class TypeDescription(Struct):
    """A message type: its fields (`{"linear": "geometry_msgs/Vector3"}`) and a message with defaults."""

    type: str
    fields: dict[str, str]
    example: dict[str, Any]


class TopicMismatch(Struct):
    """Two ends of a topic do not match, or one is missing: no message arrives. Reported once while it is so.

    `publisher` and `subscriber` are names of ROS nodes. `reason` is the difference: message type or quality
    of service; or `nobody`, if nobody publishes the topic (then `publisher` is empty), or serves the service
    or action whose client `subscriber` is. `code` names it exactly, and `values` holds what `message` tells
    except the names. `hint` says how to fix it. With `resolved`, what was reported is so no more.
    """

    topic: str
    publisher: str
    subscriber: str
    reason: Literal["type", "qos", "nobody"]
    message: str
    hint: str
    code: MismatchCode
    values: dict[str, str] = {}
    resolved: bool = False


class LaunchNode(Struct):
    """A process of the project's launch files; `file` and `line` are its place there.

    `end` is the exit code or the signal with which it ended, or the reason why it could not be started.
    """

    id: str
    name: str
    package: str
    executable: str
    file: str
    line: int
    state: LaunchState
    restarts: int = 0
    end: str = ""


class LaunchNodes(Struct):
    """All launch nodes of the application, sent when one of them changes."""

    nodes: list[LaunchNode]
