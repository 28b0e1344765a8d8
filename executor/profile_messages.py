"""The time of nodes, the profile and long ticks: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from msgspec import Struct

from executor.debug_messages import Path, Uid  # noqa: TC001 - msgspec reads the annotations


class SetProfile(Struct, forbid_unknown_fields=True):
    """Measures the time of each node from the next tick on, also in later runs, or no longer.

    With `sample`, the Python code of that leaf of the running tree is sampled too, until the next `profile`;
    `path` is its path there. Refused with `unknown_node`, or `no_python` if it is no action of the project.
    The times begin again with each command.
    """

    on: bool = True
    sample: Uid | None = None
    path: Path | None = None


class Waiting(Struct, frozen=True):
    """The action in which the present tick has been for more than half a second; empty once it has returned.

    `text` names the place for people. In an exact run the world waits for the action.
    """

    text: str = ""
    node_id: str = ""
    node_path: str = ""


class NodeTime(Struct):
    """The time of one node: how often it was ticked, with the nodes below it and without them, in ms."""

    uid: int
    calls: int
    total_ms: float
    self_ms: float


class SampledStack(Struct):
    """A stack that was seen in a sampled leaf, the outermost call first, and how often it was seen."""

    frames: list[str]
    samples: int


class Profile(Struct):
    """The times since the profile was switched on, or since the run began, of the nodes that were ticked.

    `ticks` is the number of ticks, and `tick_ms` their whole time in ms. `on` is false in the last one.
    `sample` is the uid of the leaf that is sampled, `samples` how often it was seen, and `stacks` what was
    seen most, at most 200 stacks.
    """

    on: bool
    ticks: int
    tick_ms: float
    nodes: list[NodeTime]
    sample: int | None = None
    samples: int = 0
    stacks: list[SampledStack] = []
