"""Every message of the native session protocol `bt-studio.v1`, defined once.

TypeScript types are generated from this module (`frontend/src/generated/messages.ts`), and so is the
reference page of the protocol. Units are SI; frames follow REP-103; times are simulated seconds.

Control socket (JSON text frames)
    client to server: ``{"id", "command", "data"}`` with one of `COMMANDS`;
    server to client: ``{"id", "command", "data", "seq", "t", "tick"}`` with one of `EVENTS`. A reply
    (``ack`` or ``error``) repeats the id of its command, other messages carry an id of their own.
Stream socket (MessagePack binary frames), server to client only: one of `FRAMES`, with its name in ``type``.
"""

from __future__ import annotations

from typing import Any, Final, Literal

from msgspec import UNSET, Struct, UnsetType

from executor.apply_messages import Applied, RunOn
from executor.attach_messages import Attached, AttachedTree, AttachState, Control, Groot2, ServeGroot2
from executor.command_messages import (
    COMMANDS,
    CameraPose,
    ClientMessage,
    DescribeType,
    DropBranch,
    EchoTopic,
    Empty,
    Flag,
    GoBack,
    LaunchUniverse,
    MoveBody,
    NameBranch,
    OnError,
    OnFinish,
    PublishTopic,
    ReadRecording,
    RestartNode,
    Run,
    RunApplication,
    SetBlackboard,
    SetPort,
    SetSpeed,
    SetTickRate,
    StreamName,
    Subscribe,
    Teleop,
    UniverseDocument,
    Unsubscribe,
)
from executor.debug_messages import (
    Breakpoint,
    Dap,
    Force,
    Forced,
    ForcedNode,
    Held,
    HeldInPython,
    Release,
    Released,
    SetBreakpoints,
    StepTo,
)
from executor.evaluation_events import Evaluate, EvaluationEnded, EvaluationOutcome, EvaluationStarted
from executor.profile_messages import NodeTime, Profile, SampledStack, SetProfile, Waiting
from executor.recording_events import (
    Branch,
    Differs,
    FlagSet,
    GoingBack,
    RecordingStopped,
    RepeatableRuns,
    Segment,
    StopReason,
)
from executor.source_events import (
    SourceCall,
    SourceLine,
    SourceOfTick,
    SourceProgress,
    SourceValue,
    StopSource,
    TickSource,
)
from executor.stream_messages import (
    FRAMES,
    Camera,
    Light,
    Mesh,
    Poses,
    RecordingPart,
    Scan,
    Scene,
    SceneObject,
    SensorPlacement,
    Shape,
    Texture,
    View,
)
from executor.topic_events import (
    LaunchNode,
    LaunchNodes,
    LaunchState,
    MismatchCode,
    TopicInfo,
    TopicMessage,
    TopicMismatch,
    Topics,
    TypeDescription,
)
from executor.tree_events import (
    Blackboard,
    BlackboardEntry,
    NodeStatus,
    PortEffect,
    PortSet,
    Tick,
    Tree,
    TreeNode,
)
from executor.trying_events import (
    Crash,
    StopTrying,
    TryingEnded,
    TryingProgress,
    TryingStarted,
    TryOutcome,
    TrySeeds,
    TryValues,
)

# Messages that other modules define; those defined here are public too.
__all__ = [
    "COMMANDS",
    "FRAMES",
    "Applied",
    "AttachState",
    "Attached",
    "AttachedTree",
    "Blackboard",
    "BlackboardEntry",
    "Branch",
    "Breakpoint",
    "Camera",
    "CameraPose",
    "ClientMessage",
    "Control",
    "Crash",
    "Dap",
    "DescribeType",
    "Differs",
    "DropBranch",
    "EchoTopic",
    "Empty",
    "Evaluate",
    "EvaluationEnded",
    "EvaluationOutcome",
    "EvaluationStarted",
    "Flag",
    "FlagSet",
    "Force",
    "Forced",
    "ForcedNode",
    "GoBack",
    "GoingBack",
    "Groot2",
    "Held",
    "HeldInPython",
    "LaunchNode",
    "LaunchNodes",
    "LaunchState",
    "LaunchUniverse",
    "Light",
    "Mesh",
    "MismatchCode",
    "MoveBody",
    "NameBranch",
    "NodeStatus",
    "NodeTime",
    "OnError",
    "OnFinish",
    "PortEffect",
    "PortSet",
    "Poses",
    "Profile",
    "PublishTopic",
    "ReadRecording",
    "RecordingPart",
    "RecordingStopped",
    "Release",
    "Released",
    "RepeatableRuns",
    "RestartNode",
    "Run",
    "RunApplication",
    "RunOn",
    "SampledStack",
    "Scan",
    "Scene",
    "SceneObject",
    "Segment",
    "SensorPlacement",
    "ServeGroot2",
    "SetBlackboard",
    "SetBreakpoints",
    "SetPort",
    "SetProfile",
    "SetSpeed",
    "SetTickRate",
    "Shape",
    "SourceCall",
    "SourceLine",
    "SourceOfTick",
    "SourceProgress",
    "SourceValue",
    "StepTo",
    "StopReason",
    "StopSource",
    "StopTrying",
    "StreamName",
    "Subscribe",
    "Teleop",
    "Texture",
    "Tick",
    "TickSource",
    "TopicInfo",
    "TopicMessage",
    "TopicMismatch",
    "Topics",
    "Tree",
    "TreeNode",
    "TryOutcome",
    "TrySeeds",
    "TryValues",
    "TryingEnded",
    "TryingProgress",
    "TryingStarted",
    "TypeDescription",
    "UniverseDocument",
    "Unsubscribe",
    "View",
    "Waiting",
]

PROTOCOL: Final = "bt-studio.v1"

State = Literal[
    "idle", "connected", "universe_ready", "visualization_ready", "application_running", "paused", "held"
]
Rung = Literal["connect", "launch_universe", "prepare_visualization", "run_application"]
LogSource = Literal["action", "world", "manager", "launch"]
LogLevel = Literal["debug", "info", "warning", "error"]
Role = Literal["driver", "viewer"]
FaultKind = Literal["exception", "process", "timeout", "load"]
FinishReason = Literal["root_finished", "action_raised", "terminated", "process_died"]


class Ack(Struct):
    """The command was done."""


class Error(Struct):
    """The command was refused or failed; it changed nothing."""

    code: str
    message: str
    hint: str = ""


class Introspection(Struct):
    """First message on a connection, sent again when the client's role or the properties of the world change.

    `renderer` and `tf` describe the running world: "" and false before it is ready.

    `client_id` names this client when it opens the stream socket.

    A ROS program on the session's host joins the session's graph with the variables of `ros_environment`;
    they are empty if the session is isolated.
    """

    protocol: str
    client_id: str
    role: Role
    state: State
    version: str
    ros_distro: str
    ros_domain_id: int
    renderer: str
    tf: bool
    ros_environment: dict[str, str] = {}


class StateChanged(Struct):
    """The session entered another state of the ladder.

    `reason` is for users, and empty if a command caused it.
    """

    state: State
    reason: str = ""


class Progress(Struct):
    """Progress of a long step: the fraction of this rung, 0 to 1, and a sentence."""

    rung: Rung
    fraction: float
    message: str


class Queued(Struct):
    """The session waits for a place on the server, which sends this in place of the manager.

    `before` is the number of robots that get a place before this one, null as soon as it has one; with
    `is_own` it waits until another robot of the same user ends.
    """

    before: int | None
    is_own: bool


class Log(Struct):
    """One line of output."""

    source: LogSource
    level: LogLevel
    text: str
    node_id: str = ""
    node_path: str = ""
    time: float = 0.0
    launch_node: str = ""
    """Id of the launch node that wrote the line, if the source is `launch`."""


class Fault(Struct):
    """A run-time error: an exception in an action, or a process that ended or hangs."""

    kind: FaultKind
    message: str
    hint: str = ""
    node_id: str = ""
    tree_id: str = ""
    node_path: str = ""
    file: str = ""
    line: int = 0
    traceback: str = ""


class Finished(Struct):
    """The run ended. If the root returned a status, the node is the lowest one that decided it."""

    status: NodeStatus
    reason: FinishReason
    message: str = ""
    node_id: str = ""
    tree_id: str = ""
    node_path: str = ""


class Sim(Struct):
    """The load of the simulation, about once a second."""

    real_time_factor: float
    speed: float
    paused: bool
    tick_ms: float
    tick_budget_ms: float
    collisions: int
    distance_m: float
    pose: tuple[float, float, float]
    """True pose of the first robot: x and y in m, yaw in rad, world frame."""
    camera_share: float = 1.0
    """The share of their rates at which cameras draw.

    It is below 1 if the machine is too slow for real time.
    """
    hits: int = 0
    """Number of times that something that moves ran into the robot; `collisions` are those that it caused."""


class Snapshot(Struct):
    """The full state for a client that joins late; later events change it."""

    state: State
    tree: Tree | None
    statuses: list[tuple[int, NodeStatus]]
    blackboard: list[BlackboardEntry]
    logs: list[Log]
    faults: list[Fault]
    tick_hz: float
    speed: float
    universe: str
    launch_nodes: list[LaunchNode] = []
    mismatches: list[TopicMismatch] = []
    past: list[tuple[int, NodeStatus]] = []
    finished: Finished | None = None
    ports: list[PortSet] = []
    runs: int = 0
    """The number of runs since the session began."""
    run_starts: list[tuple[int, int]] = []
    """The runs that began within `logs`: the index of the first line after it, and the run's number."""
    hanging_s: float = 0.0
    """How long the present tick has hung, s; 0 while none does."""
    segments: list[Segment] = []
    """All that can be read of the recordings of this session."""
    flags: list[FlagSet] = []
    """The flags of the present run."""
    stops: list[RecordingStopped] = []
    """Where recordings of this session stopped."""
    branches: list[Branch] = []
    """The runs of this session that continue others."""
    repeatable_runs: list[str] = []
    """The runs in which one can go back."""
    live_runs: list[str] = []
    """Those of them that are live: their world goes back, and their tree begins again."""
    runs_by_hand: dict[str, float] = {}
    """When the debugger changed those that it did, in s: one can go back only to an earlier moment."""
    held: Held | None = None
    held_in_python: HeldInPython | None = None
    forced: Forced | None = None
    attached: Attached | None = None
    attached_tree: AttachedTree | None = None
    profile: Profile | None = None
    groot2: Groot2 | None = None
    waiting: Waiting = Waiting()


EVENTS: Final[dict[str, type[Struct]]] = {
    "ack": Ack,
    "error": Error,
    "introspection": Introspection,
    "state-changed": StateChanged,
    "snapshot": Snapshot,
    "progress": Progress,
    "queued": Queued,
    "tree": Tree,
    "tick": Tick,
    "blackboard": Blackboard,
    "port_set": PortSet,
    "applied": Applied,
    "log": Log,
    "fault": Fault,
    "finished": Finished,
    "sim": Sim,
    "topics": Topics,
    "topic_message": TopicMessage,
    "type_description": TypeDescription,
    "topic_mismatch": TopicMismatch,
    "launch_nodes": LaunchNodes,
    "segment": Segment,
    "flag": FlagSet,
    "recording_stopped": RecordingStopped,
    "branch": Branch,
    "repeatable_runs": RepeatableRuns,
    "going_back": GoingBack,
    "differs": Differs,
    "held": Held,
    "held_in_python": HeldInPython,
    "released": Released,
    "forced": Forced,
    "attached": Attached,
    "attached_tree": AttachedTree,
    "profile": Profile,
    "groot2": Groot2,
    "waiting": Waiting,
    "dap": Dap,
    "evaluation_started": EvaluationStarted,
    "evaluation_outcome": EvaluationOutcome,
    "evaluation_ended": EvaluationEnded,
    "trying_started": TryingStarted,
    "trying_progress": TryingProgress,
    "try_outcome": TryOutcome,
    "trying_ended": TryingEnded,
    "source_progress": SourceProgress,
    "tick_source": TickSource,
}


class ServerMessage(Struct):
    """The envelope of an event."""

    id: str
    command: str
    data: Any
    seq: int
    t: float
    tick: int | UnsetType = UNSET
