"""Commands of the control socket: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal

import msgspec
from msgspec import Meta, Struct

from executor.apply_messages import Apply, RunOn
from executor.attach_messages import Control, ServeGroot2
from executor.debug_messages import Dap, Force, Release, SetBreakpoints, StepTo
from executor.evaluation_events import Evaluate
from executor.profile_messages import SetProfile
from executor.source_events import SourceOfTick, StopSource
from executor.trying_events import StopTrying, TrySeeds, TryValues

StreamName = Literal["poses", "scan", "camera", "view"]
OnFinish = Literal["stop", "repeat"]
OnError = Literal["stop", "failure"]
RunTime = Literal["exact", "live"]
TickRate = Annotated[float, Meta(gt=0, le=1000)]
Speed = Annotated[float, Meta(ge=0, le=10)]
StreamRate = Annotated[float, Meta(gt=0, le=120)]
StreamWidth = Annotated[int, Meta(ge=64, le=1920)]
DomainId = Annotated[int, Meta(ge=0, le=232)]
CameraName = Annotated[str, Meta(max_length=128)]
FileName = Annotated[str, Meta(min_length=1, max_length=255)]
NodeId = Annotated[str, Meta(max_length=255)]
NodePath = Annotated[str, Meta(min_length=1, max_length=65536)]
PortName = Annotated[str, Meta(min_length=1, max_length=255)]
PortValue = Annotated[str, Meta(max_length=65536)]
Velocity = Annotated[float, Meta(ge=-1000, le=1000)]


class Empty(Struct, forbid_unknown_fields=True):
    """A command without arguments."""


class UniverseDocument(Struct, forbid_unknown_fields=True):
    """A universe of the project: its YAML text, and the assets that it names.

    `file` is its name in errors.
    """

    document: str
    assets_zip_base64: str = ""
    file: FileName = "universe.yaml"


class LaunchUniverse(Struct, forbid_unknown_fields=True):
    """Starts world and robots, paused. `universe` is a built-in id or a document.

    `none` starts no world: the application joins an outside ROS graph of this machine, in the domain
    `domain_id`. If that is null, it is the `ROS_DOMAIN_ID` of the server's environment.

    With the time `exact`, runs are repeatable: world and tree are one process, and time waits for the tree. A
    run whose time cannot wait is live, and a `log` says why.
    """

    universe: str | UniverseDocument
    robot: str | None = None
    seed: int = 0
    speed: Speed = 1.0
    domain_id: DomainId | None = None
    time: RunTime = "live"


class RunApplication(Struct, forbid_unknown_fields=True):
    """(Re)starts the application from an app zip and un-pauses the world.

    `revision` is that of the project, if it is known; the recording names it.
    """

    app_zip_base64: str
    tick_hz: TickRate = 20.0
    on_finish: OnFinish = "stop"
    on_error: OnError = "stop"
    revision: Annotated[int, Meta(ge=0)] | None = None


class Run(Struct, forbid_unknown_fields=True):
    """Climbs all rungs of the ladder up to `application_running`."""

    universe: LaunchUniverse
    application: RunApplication


class SetTickRate(Struct, forbid_unknown_fields=True):
    """Sets the number of ticks for each second of simulated time, from the next tick on."""

    tick_hz: TickRate


class SetSpeed(Struct, forbid_unknown_fields=True):
    """Sets the simulated seconds for each second of real time, 0.1 to 10.

    With 0 it runs as fast as the machine can.
    """

    speed: Speed


class SetBlackboard(Struct, forbid_unknown_fields=True):
    """Writes an entry of the blackboard; `scope` is the path of a SubTree, "" for the root.

    Only while paused or held.
    """

    scope: str
    key: str
    value: Any


class SetPort(Struct, forbid_unknown_fields=True):
    """Gives a port of a running node another text from the next tick on; null removes its text.

    The node is the one with the id `node_id` in the diagram at `path`, which names its instance as in the
    event `tree`. `value` is a text as in the diagram: a literal, or `{key}`. Refused with `port_fixed` if the
    engine reads the port only when the tree is built, and with `bad_port` if the port does not take the text.
    """

    node_id: NodeId
    path: NodePath
    port: PortName
    value: PortValue | None = None


class Teleop(Struct, forbid_unknown_fields=True):
    """Drives the robot by hand: linear x in m/s, angular z in rad/s."""

    linear: Velocity
    angular: Velocity


class MoveBody(Struct, forbid_unknown_fields=True):
    """Moves a body to a pose [x, y, z, roll, pitch, yaw] in m and rad. Only while paused."""

    id: str
    pose: tuple[float, float, float, float, float, float]


class CameraPose(Struct, forbid_unknown_fields=True):
    """Camera of the server's view of the world: eye and target in m, world frame."""

    eye: tuple[float, float, float]
    target: tuple[float, float, float]


class Subscribe(Struct, forbid_unknown_fields=True):
    """Subscribes to a stream on this client's stream socket, or changes a subscription.

    Each camera is a subscription of its own: `sensor` names it as its `camera` frames do, by the sensor's
    name, and `robot/sensor` for every robot but the first. "" is the first camera of the world.
    """

    stream: StreamName
    max_hz: StreamRate = 30.0
    width: StreamWidth | None = None
    camera_pose: CameraPose | None = None
    sensor: CameraName = ""


class Unsubscribe(Struct, forbid_unknown_fields=True):
    """Ends a stream; of `camera` that of the same `sensor`."""

    stream: StreamName
    sensor: CameraName = ""


class EchoTopic(Struct, forbid_unknown_fields=True):
    """Sends the latest message of a topic as `topic_message`, at most `max_hz` times a second.

    0 ends the echo.

    If several clients echo a topic, all receive it at the highest of their rates.
    """

    topic: str
    max_hz: Annotated[float, Meta(ge=0, le=120)] = 10.0


class PublishTopic(Struct, forbid_unknown_fields=True):
    """Publishes one message; `message` holds the fields of `type` (`std_msgs/msg/String`) as JSON.

    Missing fields get their defaults. `"inf"`, `"-inf"` and `"nan"` stand for the numbers that JSON lacks.
    """

    topic: str
    type: str
    message: dict[str, Any]


class DescribeType(Struct, forbid_unknown_fields=True):
    """Requests the fields of a message type; this client alone receives a `type_description`."""

    type: str


class RestartNode(Struct, forbid_unknown_fields=True):
    """Restarts a launch node of the project; `id` is its id in the event `launch_nodes`."""

    id: str


class ReadRecording(Struct, forbid_unknown_fields=True):
    """Reads a part of a segment: a frame `recording` on this client's stream socket comes before the reply.

    Refused with `not_recorded` if the segment, or this version of it, is not there any more.
    """

    run: Annotated[str, Meta(max_length=32)]
    segment: Annotated[int, Meta(ge=0)]
    version: Annotated[int, Meta(ge=0)]
    offset: Annotated[int, Meta(ge=0)]
    length: Annotated[int, Meta(gt=0, le=1 << 20)]
    branch: Annotated[int, Meta(ge=0, le=0)] = 0


class Flag(Struct, forbid_unknown_fields=True):
    """Sets, changes or removes a flag: a mark of the user in the recording of the present run.

    `t` is its moment in s; null is the present, or leaves the moment of a flag as it is. `id` names the flag
    to change, "" sets a new one; an empty `text` removes it. `user` is who sets it, as the client names them;
    in a session of the web server it is the user who is signed in, whatever the client says.
    With `run` the command is refused (`not_present`) if another run has begun. Other refusals:
    `not_recorded`, `unknown_flag`, `no_text`, and `too_many` beyond 200 flags of a run.
    """

    text: Annotated[str, Meta(max_length=1000)]
    t: Annotated[float, Meta(ge=0, le=1e7)] | None = None
    id: Annotated[str, Meta(max_length=32)] = ""
    user: Annotated[str, Meta(max_length=150)] = ""
    run: Annotated[str, Meta(max_length=32)] = ""


class GoBack(Struct, forbid_unknown_fields=True):
    """Takes world and program of a run back to the moment `t` in s, where they are paused.

    The moment is that after the first tick that is not earlier; without `t` it is the end of the run. `run`
    is one of this session in the present world, "" the present or last one. An exact run is made again from
    its begin, and the events `going_back` say how far it is. The world of a live run goes back to its last
    recorded state that is not later (they are 5 s apart), and its tree begins again, with the recorded
    blackboard; a line of the console names the entries that are left empty. What follows is recorded as a run
    of its own (`branch`). Refused with `no_run`, `unknown_run`, `not_repeatable`, `not_recorded`, or
    `changed_by_hand` for a moment after which the debugger had changed the program of an exact run.
    """

    run: Annotated[str, Meta(max_length=64)] = ""
    t: Annotated[float, Meta(ge=0)] | None = None


class TickBack(Struct, forbid_unknown_fields=True):
    """Takes the present exact run back to the begin of its last whole tick, where it is paused.

    A tick in which the debugger holds the tree is not whole: it is undone, too. What entered before the begin
    of that tick is done again, the tick is not. What follows is a branch, as for `go_back`; one in which
    nothing else happened than in its parent is thrown away. Refused with `live_run`, `first_tick` where there
    is no earlier tick, `not_repeatable`, or `changed_by_hand`.
    """


class NameBranch(Struct, forbid_unknown_fields=True):
    """Gives a branch a name, or none; the event `branch` follows. Refused with `unknown_branch`."""

    run: Annotated[str, Meta(min_length=1, max_length=64)]
    name: Annotated[str, Meta(max_length=80)]


class DropBranch(Struct, forbid_unknown_fields=True):
    """Throws a branch away, with its recording; the event `branch` follows.

    Refused with `unknown_branch`, or with `present_run` for that of the present.
    """

    run: Annotated[str, Meta(min_length=1, max_length=64)]


COMMANDS: Final[dict[str, type[Struct]]] = {
    "dap": Dap,
    "connect": Empty,
    "launch_universe": LaunchUniverse,
    "prepare_visualization": Empty,
    "run_application": RunApplication,
    "apply": Apply,
    "run": Run,
    "pause": Empty,
    "resume": Empty,
    "step": Empty,
    "go_back": GoBack,
    "tick_back": TickBack,
    "run_on": RunOn,
    "branches": Empty,
    "name_branch": NameBranch,
    "drop_branch": DropBranch,
    "cancel": Empty,
    "set_tick_rate": SetTickRate,
    "set_speed": SetSpeed,
    "restart_application": Empty,
    "reset_world": Empty,
    "run_world": Empty,
    "terminate_application": Empty,
    "terminate_visualization": Empty,
    "terminate_universe": Empty,
    "disconnect": Empty,
    "set_blackboard": SetBlackboard,
    "set_port": SetPort,
    "set_breakpoints": SetBreakpoints,
    "continue_run": Empty,
    "step_into": Empty,
    "step_over": Empty,
    "step_out": Empty,
    "step_to": StepTo,
    "force": Force,
    "release": Release,
    "control": Control,
    "profile": SetProfile,
    "serve_groot2": ServeGroot2,
    "teleop": Teleop,
    "move_body": MoveBody,
    "subscribe": Subscribe,
    "unsubscribe": Unsubscribe,
    "list_topics": Empty,
    "echo_topic": EchoTopic,
    "publish_topic": PublishTopic,
    "describe_type": DescribeType,
    "restart_node": RestartNode,
    "read_recording": ReadRecording,
    "flag": Flag,
    "evaluate": Evaluate,
    "try_values": TryValues,
    "try_seeds": TrySeeds,
    "stop_trying": StopTrying,
    "source_of_tick": SourceOfTick,
    "stop_source": StopSource,
    "take_over": Empty,
    "ping": Empty,
}


class ClientMessage(Struct):
    """The envelope of a command; `data` is decoded as `COMMANDS[command]`."""

    id: str
    command: str
    data: msgspec.Raw = msgspec.Raw(b"null")
