"""The commands and the events of the debugger: a part of the protocol in `executor.messages`.

A node of the running tree is named by its `uid` in the event `tree`, and by its path there, so that a command
for an earlier tree is refused (`unknown_node`).
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

from executor.tree_events import NodeStatus  # noqa: TC001 - msgspec reads the annotations

Key = Annotated[str, Meta(min_length=1, max_length=255)]
Uid = Annotated[int, Meta(ge=1, le=1_000_000)]
Path = Annotated[str, Meta(min_length=1, max_length=65536)]
ResultName = Literal["RUNNING", "SUCCESS", "FAILURE", "SKIPPED"]
BreakpointMoment = Literal["before", "after", "returns", "halted"]
ForceEffect = Literal["result", "skip_to", "alone"]
HeldEvent = Literal["before", "after", "decided", "halted"]
HeldCause = Literal["breakpoint", "step", "condition"]


class Breakpoint(Struct, forbid_unknown_fields=True):
    """A breakpoint on a block.

    `tree_id` is the ID of the block's BehaviorTree, and `node_id` its id in the diagram. `instance` has the
    ids of the SubTree nodes that lead to one instance, from the main tree on; null stands for all instances.
    `when` is the moment, and `status` the result for `returns`. `condition` is a script that must be true,
    and `hits` the first hit that counts. With `log` this line is written in place of a stop.
    """

    tree_id: Key
    node_id: Key
    instance: Annotated[list[Key], Meta(max_length=100)] | None = None
    when: BreakpointMoment = "before"
    status: ResultName | None = None
    condition: Annotated[str, Meta(max_length=1000)] = ""
    hits: Annotated[int, Meta(ge=1, le=1_000_000)] = 1
    log: Annotated[str, Meta(max_length=1000)] = ""
    on: bool = True


class SetBreakpoints(Struct, forbid_unknown_fields=True):
    """Replaces all breakpoints of the session; they also hold for later runs.

    With `on` false none has an effect. Refused with `bad_breakpoint` if one cannot be set in the running
    tree; all are as they were then. A program that is loading or ending, or that does not answer, cannot
    refuse them: what it does not take then, it names in the log.
    """

    breakpoints: Annotated[list[Breakpoint], Meta(max_length=500)]
    on: bool = True


class StepTo(Struct, forbid_unknown_fields=True):
    """Continues until a node is to be ticked."""

    uid: Uid
    path: Path


class Force(Struct, forbid_unknown_fields=True):
    """Forces a result on a node, in place of what was forced on it before.

    `effect` is `result` for the result `status` in place of its tick (with `after`, of the tick's own
    result), `skip_to` to skip the siblings before it once, or `alone` to tick it in place of the
    root. RUNNING freezes the node. `once` is for one tick, else it holds until it is released.
    Refused with `not_forced`.
    """

    uid: Uid
    path: Path
    effect: ForceEffect = "result"
    status: ResultName = "SUCCESS"
    once: bool = False
    after: bool = False


class Release(Struct, forbid_unknown_fields=True):
    """Ends what is forced on a node; null for all nodes."""

    uid: Uid | None = None


class Dap(Struct, forbid_unknown_fields=True):
    """A message of the Debug Adapter Protocol, for breakpoints in Python; both ways, for the driver alone.

    `message` is a request of the client, or a response or event. Files have their names in the project. A
    client sends `initialize` once; the session attaches to each program by itself, and `initialized` comes
    before the code of the program is loaded. The session refuses requests that are not listed
    (`not_allowed`), files outside of the project (`bad_path`), and more than 1 MiB (`too_large`).
    """

    message: dict[str, Any]


class Held(Struct):
    """The tree is held at a node, within a tick.

    `path` has the uids from the root to the node `uid`, and `ahead` those that the rules may still tick in
    this tick: possible ones, not certain ones. `why` is the reason in words, and `cause` its kind. `event` is
    what happens at the node: `status` is its result, and `decided` the pre-condition that gave it without a
    tick. `statuses` are those of all nodes that are not IDLE. `hook` counts the stops of the tick, from 0.
    With `outside` the robot is not held: it belongs to an outside ROS graph.
    """

    uid: int
    path: list[int]
    why: str
    ahead: list[int]
    cause: HeldCause
    event: HeldEvent
    tick: int
    status: ResultName | None = None
    decided: str = ""
    statuses: list[tuple[int, ResultName]] = []
    hook: int = 0
    outside: bool = False


class HeldInPython(Struct):
    """The program is held at a line of Python within a tick, of which this is known so far.

    `path` has the uids from the root to the node `uid`, whose code is held. `statuses` are those of all nodes
    that are not IDLE. It holds until the state is not `held` any more, or until the next event `tick`, `held`
    or `held_in_python`.
    """

    uid: int
    path: list[int]
    tick: int
    statuses: list[tuple[int, NodeStatus]] = []


class Released(Struct):
    """The tree is not held any more.

    With `off` all breakpoints are off now, as after a hold that lasted too long.
    """

    off: bool = False


class ForcedNode(Struct):
    """A result that is forced on a node; `skips_to` is the node to which the skips lead, or 0."""

    uid: int
    status: ResultName
    once: bool
    after: bool
    skips_to: int = 0


class Forced(Struct):
    """All that is forced now; `alone` is the uid of the node that runs alone, or 0."""

    nodes: list[ForcedNode]
    alone: int = 0
