"""Messages to and from a world process (`executor.world.process`)."""

from __future__ import annotations

from typing import Any

from msgspec import field

from executor import messages
from executor.child_messages.common import Asked, BeginRecording, Message, Pause, Resume


class StartWorld(Message, tag="start"):
    """Builds a world.

    `universe` is an id or a document; with `none` the process joins an outside ROS graph instead.

    `file` is the name of the document in errors. `assets` is the folder with the files that the document
    refers to.
    """

    universe: str
    file: str = ""
    assets: str = ""
    robot: str | None = None
    seed: int = 0
    speed: float = 1.0
    domain_id: int = 0


class StepWorld(Asked, tag="step"):
    """Simulates `dt_s` seconds of a paused world."""

    dt_s: float


class Reset(Asked, tag="reset"):
    """Resets the world to its initial state."""


class SetSpeed(Asked, tag="set_speed"):
    """Sets the number of simulated seconds for each second of real time."""

    speed: float


class StopRobot(Message, tag="stop_robot"):
    """Sets the target velocity of every robot to zero."""


class Teleop(Message, tag="teleop"):
    """Drives the first robot. With `goes_on`, a paused world runs for a moment so that the robot moves."""

    linear: float
    angular: float
    goes_on: bool = False


class MoveBody(Asked, tag="move_body"):
    """Moves a body to a pose."""

    id: str
    pose: tuple[float, float, float, float, float, float]


class ExpectNavigators(Message, tag="expect_navigators"):
    """Nodes were started that may offer navigation: the world offers none while they join the graph."""

    names: list[str]


class Subscribe(Message, tag="subscribe"):
    """Subscribes a client to a stream, or changes the subscription."""

    client: str
    stream: messages.StreamName
    max_hz: float = 30.0
    width: int | None = None
    camera_pose: messages.CameraPose | None = None
    sensor: str = ""


class Unsubscribe(Message, tag="unsubscribe"):
    """Ends a client's subscription to a stream."""

    client: str
    stream: messages.StreamName
    sensor: str = ""


class Pace(Message, tag="pace"):
    """Reports the share of pictures for which a client was too slow, 0 to 1."""

    client: str
    lost: float


class DumpWorld(Asked, tag="dump"):
    """Requests the state of the world; a `WorldState` comes before the answer."""


class LoadWorld(Asked, tag="load"):
    """Restores a state of this world that another process sent."""

    data: bytes


class ListTopics(Asked, tag="list_topics"):
    """Requests the topics of the ROS graph."""


class EchoTopic(Asked, tag="echo_topic"):
    """Requests the messages of a topic; a `patient` request waits for a topic that does not exist yet."""

    topic: str
    max_hz: float
    patient: bool = False


class PublishTopic(Asked, tag="publish_topic"):
    """Publishes one message."""

    topic: str
    message_type: str
    message: dict[str, Any]


class DescribeType(Asked, tag="describe_type"):
    """Requests the fields of a message type."""

    message_type: str


WorldCommand = (
    BeginRecording
    | Pause
    | Resume
    | StepWorld
    | Reset
    | SetSpeed
    | StopRobot
    | Teleop
    | MoveBody
    | ExpectNavigators
    | Subscribe
    | Unsubscribe
    | Pace
    | ListTopics
    | EchoTopic
    | PublishTopic
    | DescribeType
)
"""A command for a world that was started."""


class WorldReady(Message, tag="ready"):
    """The world is built, and paused."""

    renderer: str = ""
    tf: bool = False
    universe: str = ""


class WorldState(Asked, tag="world_state"):
    """The state of the world as `World.dump` returns it: an answer, or what an exact run leaves."""

    data: bytes


class Progress(Message, tag="progress"):
    """The progress of the start: `fraction` is 0 to 1."""

    fraction: float
    message: str


class Failed(Asked, tag="error"):
    """A message without a token could not be carried out."""

    code: str
    message: str
    hint: str = ""


class Sim(messages.Sim, tag_field="type", tag="sim", kw_only=True):
    """The event `sim` at the simulated time `t`; the session adds the load of the ticks."""

    t: float


class TopicMismatch(messages.TopicMismatch, tag_field="type", tag="topic_mismatch"):
    """The event `topic_mismatch` for clients."""


class Topics(Asked, tag="topics"):
    """The event `topics` for clients."""

    topics: list[messages.TopicInfo]


class TopicMessage(Asked, tag="topic_message"):
    """The event `topic_message`; its field `type` is called `message_type` here."""

    topic: str
    message_type: str
    message: dict[str, Any]
    bytes: int = 0
    cut: dict[str, int] = field(default_factory=dict)


class TypeDescription(Asked, tag="type_description"):
    """The event `type_description`; its field `type` is called `message_type` here."""

    message_type: str
    fields: dict[str, str]
    example: dict[str, Any]


class Frame(Message, tag="frame"):
    """A frame of the stream socket for one client (None: for all).

    `data` is the encoded frame; the manager does not change it. A newer frame of the same `stream` replaces
    an unsent one, unless `keep` is set, as for a scene, to which later frames refer. `stream` is the name of
    the stream, or `camera/NAME` for a camera that was requested by name.
    """

    client: str | None
    stream: str
    data: bytes
    keep: bool = False
