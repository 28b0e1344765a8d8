"""Messages to and from an application process (`executor.application.process`)."""

from __future__ import annotations

from typing import Any, Literal

from executor import messages
from executor.child_messages.common import Asked, Message
from executor.child_messages.world import StartWorld  # noqa: TC001 - msgspec reads the annotations
from executor.replay_messages import Replay  # noqa: TC001 - msgspec reads the annotations

DebugStep = Literal["continue", "into", "over", "out", "to"]


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
    attach: str = ""
    """The address HOST:PORT of the program that is followed in place of an application; "" for none."""
    time_s: float | None = None
    """The simulated time until it resumes, where the time of the world has gone back."""
    blackboard_json: str = ""
    """The recorded entries with which the blackboard of a live run begins; "" for none."""


class ConnectDebugger(Message, tag="connect_debugger"):
    """Connects the process with debugpy's adapter on a port of this machine."""

    port: int
    token: str


class PythonLineWrong(Message, tag="python_line_wrong"):
    """An expression of a breakpoint in Python cannot be evaluated; `path` is a file of the project."""

    path: str
    line: int
    text: str


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


class HeldInPython(messages.HeldInPython, tag_field="type", tag="held_in_python"):
    """The event `held_in_python` for clients."""


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
