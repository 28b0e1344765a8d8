"""Messages between the manager and its child processes, defined once for both ends.

Each message is a tagged struct; its tag is the field ``type``. A channel decodes one of these unions:

    ToWorld, FromWorld                world process (`executor.world.process`)
    ToApplication, FromApplication    application process (`executor.application.process`)
    ToExact, FromExact                process of an exact run (`executor.exact.process`): both in one
    ToRecorder, FromRecorder          recorder process (`executor.recorder_messages`)

Bytes that are not a message of the union cannot be decoded: the manager ends such a child with a fault that
says why, and a child ends itself. Both ends always have the same version, so nothing is versioned here.
Messages that become events of the session protocol extend the event of the same name (`executor.messages`).

A message with a `request` asks for an answer; the answer repeats that token.

The module has more than 500 lines because it is the whole contract of two channels: the unions at its end
name every message, and both ends import all of them.
"""

from __future__ import annotations

from typing import Any, Final, Literal, TypeVar

import msgspec
from msgspec import Struct

from executor import messages
from executor.replay_messages import Input, Replay  # noqa: TC001 - msgspec reads the annotations

Event = TypeVar("Event", bound=Struct)
DebugStep = Literal["continue", "into", "over", "out", "to"]


class Message(Struct, tag_field="type", omit_defaults=True):
    """Base class of messages without an answer."""


class Asked(Struct, tag_field="type", omit_defaults=True, kw_only=True):
    """Base class of a request or of its answer.

    `request` is its token, or None if no client waits for an answer.
    """

    request: str | None = None


# --- to both --------------------------------------------------------------------------------------


class Stop(Message, tag="stop"):
    """Ends the process."""


class Pause(Asked, tag="pause"):
    """Pauses simulated time, or ticks."""


class Resume(Asked, tag="resume"):
    """Resumes simulated time, or ticks."""


class BeginRecording(Message, tag="begin_recording"):
    """Begins the recording of a run: all that follows belongs to it.

    With `resets` simulated time goes back to 0 now; the application notices it a little later.
    """

    run: str
    resets: bool = False


# --- to the world ---------------------------------------------------------------------------------


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
    | Subscribe
    | Unsubscribe
    | Pace
    | ListTopics
    | EchoTopic
    | PublishTopic
    | DescribeType
)
"""A command for a world that was started."""


# --- to an exact run ------------------------------------------------------------------------------


class KeepSnapshots(Message, tag="keep_snapshots"):
    """Sets whether the run makes snapshots of itself."""

    is_on: bool


class TakeSnapshot(Message, tag="take_snapshot"):
    """Makes a snapshot now; the answer is a `SnapshotTaken` or a `NoSnapshots`."""


class Awake(Message, tag="awake"):
    """Makes the copy of a snapshot make the run again from there, up to a moment."""

    replay: Replay
    speed: float


# --- to the application ---------------------------------------------------------------------------


class StartApplication(Message, tag="start"):
    """Loads the application in `app_dir`, which then waits, paused.

    With `outside`, it uses the time of an outside ROS graph. `breakpoints` are set before the first tick.
    """

    app_dir: str
    tick_hz: float
    on_finish: messages.OnFinish = "stop"
    on_error: messages.OnError = "stop"
    seed: int = 0
    domain_id: int | None = None
    outside: bool = False
    breakpoints: messages.SetBreakpoints | None = None
    profile: messages.SetProfile | None = None
    groot2: int = 0
    """The port at which clients of Groot2's protocol may look at the tree; 0 for none."""
    is_debugged: bool = False
    """Whether it waits for `ConnectDebugger`, and for Python breakpoints, before it loads the code."""
    world: StartWorld | None = None
    """The world of an exact run, which is simulated in the same process."""
    world_state: bytes = b""
    """The state with which that world begins; empty for its initial state."""
    replay: Replay | None = None
    """What the exact run does before it is ready: an earlier one again, up to a moment."""
    time_s: float | None = None
    """The simulated time until it resumes, where the time of the world has gone back."""
    blackboard_json: str = ""
    """The recorded entries with which the blackboard of a live run begins; "" for none."""


class ConnectDebugger(Message, tag="connect_debugger"):
    """Connects the process with debugpy's adapter on a port of this machine."""

    port: int
    token: str


class TracePython(Message, tag="trace_python"):
    """Starts or stops the tracing of Python code in a process that a Python debugger is connected with."""

    is_on: bool


class StepTick(Message, tag="step"):
    """Ticks once; the answer is a `Stepped`."""


class SetTickRate(Asked, tag="set_tick_rate"):
    """Sets the number of ticks for each second of simulated time."""

    tick_hz: float


class SetBlackboard(Message, tag="set_blackboard"):
    """Writes an entry of the blackboard; the answer is a `BlackboardSet`."""

    scope: str
    key: str
    value: Any


class SetPort(Asked, tag="set_port"):
    """Gives a port of a node another text, or none; a `PortSet` comes before the answer."""

    node_id: str
    path: str
    port: str
    value: str | None


class ApplyApplication(Asked, tag="apply"):
    """Replaces the tree by that of the application in `app_dir`; an `Applied` comes before the answer.

    With `dry` nothing changes.
    """

    app_dir: str
    dry: bool = False


class SetBreakpoints(Asked, tag="set_breakpoints"):
    """Replaces the breakpoints."""

    wanted: messages.SetBreakpoints


class Continue(Asked, tag="continue"):
    """Continues a held tree; `step` ends at a later event, at the node `uid` for `to`.

    With `off` all breakpoints are switched off. With `pauses` ticks are paused after the one in progress.
    """

    step: DebugStep = "continue"
    uid: int = 0
    path: str = ""
    off: bool = False
    pauses: bool = False


class ForceResult(Asked, tag="force"):
    """Forces a result on a node."""

    force: messages.Force


class ServeGroot2(Asked, tag="serve_groot2"):
    """Allows clients of Groot2's protocol to look at the tree at a port, or no longer with 0."""

    port: int


class MeasureNodes(Asked, tag="profile"):
    """Measures the time of each node from the next tick on, or no longer."""

    wanted: messages.SetProfile


class ReleaseForced(Asked, tag="release"):
    """Ends what is forced on a node, or on all nodes."""

    uid: int | None = None


class Control(Asked, tag="control"):
    """Sets whether the user controls the robot of an attached session."""

    on: bool


# --- to an exact run ------------------------------------------------------------------------------


class ForWorld(Message, tag="for_world"):
    """A command for the world of an exact run."""

    command: WorldCommand


# --- from both ------------------------------------------------------------------------------------


class Place(Struct, omit_defaults=True):
    """The place of a child's main thread: `text` for people.

    The other fields are set while it runs an action.
    """

    text: str = ""
    node_id: str = ""
    tree_id: str = ""
    node_path: str = ""
    node_type: str = ""
    file: str = ""
    line: int = 0
    traceback: str = ""


class Beat(Message, tag="beat"):
    """Sign of life of a child (`executor.supervision.pulse`).

    Attributes:
        turns: number of times that the main thread completed its loop.
        task: the name of the thing that the main thread loads; "" after loading, while it runs its loop.
        clocks: number of times that simulated time was published (world) or received (application).
        place: the place of the main thread, if it has not completed its loop for a while.
    """

    turns: int
    task: str = ""
    clocks: int = 0
    place: Place | None = None


class Log(Message, tag="log"):
    """One line of output; if `time` is None, the session's own time is used."""

    level: messages.LogLevel
    text: str
    node_id: str = ""
    node_path: str = ""
    time: float | None = None
    of_world: bool = False
    """Whether the world wrote it, in a process that also runs the application."""


class Starting(Message, tag="starting"):
    """The child received its start message."""


class Answer(Asked, tag="answer"):
    """A request was carried out, or failed with an error."""

    error: messages.Error | None = None


# --- from the world -------------------------------------------------------------------------------


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
    cut: dict[str, int] = {}


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


# --- from the application -------------------------------------------------------------------------


class ApplicationReady(Message, tag="ready"):
    """The application is loaded, and paused."""


class Paused(Message, tag="paused"):
    """Ticks are paused."""


class Resumed(Message, tag="resumed"):
    """Ticks are resumed."""


class Stepped(Message, tag="stepped"):
    """One tick was executed."""


class BlackboardSet(Message, tag="blackboard_set"):
    """An entry was written, or `error` is the reason why not."""

    error: str = ""


class Tree(messages.Tree, tag_field="type", tag="tree"):
    """The event `tree` for clients."""


class Tick(messages.Tick, tag_field="type", tag="tick", kw_only=True):
    """The event `tick` at the simulated time `t`."""

    t: float


class Blackboard(messages.Blackboard, tag_field="type", tag="blackboard"):
    """The event `blackboard` for clients."""


class PortSet(messages.PortSet, tag_field="type", tag="port_set"):
    """The event `port_set` for clients."""


class Applied(messages.Applied, tag_field="type", tag="applied"):
    """The event `applied` for clients."""


class Held(messages.Held, tag_field="type", tag="held"):
    """The event `held` for clients."""


class Released(Message, tag="released"):
    """The tree runs on after a hold; if it is `paused`, no tick follows the one in progress."""

    paused: bool = False


class Forced(messages.Forced, tag_field="type", tag="forced"):
    """The event `forced` for clients."""


class Attached(messages.Attached, tag_field="type", tag="attached"):
    """The event `attached` for clients."""


class AttachedTree(messages.AttachedTree, tag_field="type", tag="attached_tree"):
    """The event `attached_tree` for clients."""


class Profile(messages.Profile, tag_field="type", tag="profile"):
    """The event `profile` for clients."""


class Fault(messages.Fault, tag_field="type", tag="fault"):
    """The event `fault` for clients."""


class Finished(messages.Finished, tag_field="type", tag="finished"):
    """The event `finished` for clients."""


# --- from an exact run ----------------------------------------------------------------------------


class Entered(Message, tag="entered"):
    """Something from outside changed the run."""

    input: Input


class Fingerprints(Message, tag="fingerprints"):
    """The fingerprints of the ticks since the last such message, one after the other."""

    data: bytes


class GoingBack(Message, tag="going_back"):
    """The share of the way to the moment of a `Replay`, 0 to 1."""

    fraction: float


class Differs(Message, tag="differs"):
    """The run that is made again differs from the first time from a tick on, at a simulated time in s."""

    tick: int
    t: float
    cause: str


class WentBack(Message, tag="went_back"):
    """The run was made again up to the moment of a `Replay`; it is paused there.

    Attributes:
        t: the simulated time in s.
        ticks: the number of ticks that were made.
        inputs: the number of inputs that were given.
        resets: the number of resets of the world among them.
        tick_hz: the ticks in a second of simulated time.
    """

    t: float
    ticks: int
    inputs: int
    resets: int
    tick_hz: float


class SnapshotTaken(Message, tag="snapshot_taken"):
    """The run has made a snapshot of itself.

    Attributes:
        number: its number in this process.
        t: the simulated time in s.
        ticks: the number of ticks that were made before.
        inputs: the number of inputs that had entered.
        resets: the number of resets of the world among them.
        is_at_tick: whether nothing was simulated since the last tick.
        cost_s: the processor time in s that the run had taken up to there.
        draws: whether the run draws pictures.
        is_wanted: whether the session asked for it.
    """

    number: int
    t: float
    ticks: int
    inputs: int
    resets: int
    is_at_tick: bool
    cost_s: float
    draws: bool = False
    is_wanted: bool = False


class NoSnapshots(Message, tag="no_snapshots"):
    """The run makes no snapshots of itself now, for a reason: the end of a sentence."""

    reason: str
    is_wanted: bool = False


ToWorld = StartWorld | Stop | DumpWorld | LoadWorld | WorldCommand
FromWorld = (
    Beat
    | Log
    | Starting
    | Answer
    | WorldReady
    | Progress
    | Failed
    | Sim
    | TopicMismatch
    | Topics
    | TopicMessage
    | TypeDescription
    | Frame
    | WorldState
)
ToApplication = (
    StartApplication
    | Stop
    | BeginRecording
    | Pause
    | Resume
    | StepTick
    | SetTickRate
    | SetBlackboard
    | SetPort
    | ApplyApplication
    | SetBreakpoints
    | Continue
    | ForceResult
    | ReleaseForced
    | Control
    | MeasureNodes
    | ServeGroot2
    | ConnectDebugger
    | TracePython
)
FromApplication = (
    Beat
    | Log
    | Starting
    | Answer
    | ApplicationReady
    | Paused
    | Resumed
    | Stepped
    | BlackboardSet
    | Tree
    | Tick
    | Blackboard
    | PortSet
    | Applied
    | Held
    | Released
    | Forced
    | Attached
    | AttachedTree
    | Profile
    | Fault
    | Finished
)
ToExact = ToApplication | ForWorld | KeepSnapshots | TakeSnapshot | Awake
FromExact = (
    FromApplication
    | Failed
    | Sim
    | TopicMismatch
    | Topics
    | TopicMessage
    | TypeDescription
    | Frame
    | WorldState
    | Entered
    | Fingerprints
    | GoingBack
    | Differs
    | WentBack
    | SnapshotTaken
    | NoSnapshots
)
decode_to_world: Final = msgspec.msgpack.Decoder(ToWorld).decode
decode_from_world: Final = msgspec.msgpack.Decoder(FromWorld).decode
decode_to_application: Final = msgspec.msgpack.Decoder(ToApplication).decode
decode_from_application: Final = msgspec.msgpack.Decoder(FromApplication).decode
decode_to_exact: Final = msgspec.msgpack.Decoder(ToExact).decode
decode_from_exact: Final = msgspec.msgpack.Decoder(FromExact).decode
Request = (
    Pause
    | Resume
    | StepWorld
    | Reset
    | SetSpeed
    | MoveBody
    | DumpWorld
    | LoadWorld
    | ListTopics
    | EchoTopic
    | PublishTopic
    | DescribeType
    | SetTickRate
    | SetPort
    | ApplyApplication
    | SetBreakpoints
    | Continue
    | ForceResult
    | ReleaseForced
    | Control
    | MeasureNodes
    | ServeGroot2
)
"""Messages that a child answers with `Answer`."""


def name_of(message: Struct) -> str:
    """Returns the tag of a message."""
    return str(type(message).__struct_config__.tag)


def event_of(message: Struct, event: type[Event]) -> Event:
    """Returns the event that a message extends, without the fields that only the channel uses.

    Nested structs are shared, not copied.
    """
    return msgspec.convert(message, event, from_attributes=True)
