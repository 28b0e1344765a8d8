"""`Stage`: the interface of the session for its parts, and the values that they share.

The parts of the session (`steps`, `running`, `immediate`, `streaming`, `child_events`, `child_exits`,
`launch_nodes` and `watch`) import this module, and `protocol.Session` imports the parts: no part knows the
session itself.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from executor.launching.model import LaunchPlan

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from executor import messages
    from executor.child_messages import StartWorld
    from executor.session.children import Children
    from executor.session.clients import Clients
    from executor.session.debugger.attaching import Attaching
    from executor.session.debugger.holding import Hold
    from executor.session.debugger.python import PythonDebugger
    from executor.session.evaluation.evaluating import Evaluating
    from executor.session.events import Unpacked
    from executor.session.exact.past import PastRuns
    from executor.session.exact.snapshots import Snapshots
    from executor.session.exact.sources import Sources
    from executor.session.exact.trying import Trying
    from executor.session.ladder import State
    from executor.session.launch_nodes import LaunchNodes
    from executor.session.mirror import Mirror
    from executor.session.output import Output
    from executor.session.questions import Questions
    from executor.session.runs.recording import Recording
    from executor.session.waits import Step

__all__ = ["About", "LastRun", "Stage"]


@dataclass(frozen=True)
class About:
    """Properties that do not change during a session."""

    version: str
    ros_distro: str = "jazzy"
    ros_domain_id: int = 0
    ros_environment: Mapping[str, str] = field(default_factory=dict)
    outside_domain_id: int = 0
    grace_s: float = 300.0
    patience_s: float = 0.0
    """Seconds after the start at which the grace for the first client begins."""
    promote_s: float = 5.0
    hold_limit_s: float = 900.0
    """Seconds after which a tree that the debugger holds runs on; 0 is without limit."""


@dataclass
class LastRun:
    """The data of the last run, which a restart needs."""

    universe: messages.LaunchUniverse | None = None
    application: messages.RunApplication | None = None
    folder: str = ""
    plan: LaunchPlan = field(default_factory=LaunchPlan)
    domain_id: int = 0
    is_outside: bool = False
    seed: int = 0
    world: StartWorld | None = None
    """The world as it was launched, which an exact run builds too."""
    wants_exact: bool = False
    """Whether exact runs are wanted, in which time waits for the tree."""
    is_world_alone: bool = False
    """The world runs without an application."""
    deaf_until_s: float = 0.0
    """Until this time, an application that receives no simulated time is not restarted again."""


class Stage(Protocol):
    """The part of a session's interface that its steps and other parts use."""

    about: About
    mirror: Mirror
    clients: Clients
    children: Children
    questions: Questions
    nodes: LaunchNodes
    output: Output
    recording: Recording
    evaluating: Evaluating
    trying: Trying
    sources: Sources
    run: LastRun
    past: PastRuns
    snapshots: Snapshots
    hold: Hold
    attaching: Attaching | None
    python: PythonDebugger
    now_s: float
    sim_time_s: float

    @property
    def state(self) -> State:
        """The state of the ladder."""

    @property
    def is_free(self) -> bool:
        """Whether no step is in progress."""

    def enter(self, state: State, reason: str = "") -> None:
        """Changes the state of the ladder."""

    def introspect(self, client: str) -> None:
        """Sends a client the properties of the session and its role in it."""

    def know_world(self, renderer: str, *, has_tf: bool) -> None:
        """Stores the capabilities of the world: its renderer, and whether it publishes tf."""

    def unpack(self, archive_base64: str) -> Callable[[], Unpacked | None]:
        """Orders an archive to be unpacked.

        Returns a function that returns the result, or None before it exists.
        """

    def begin_own(self, command: str, generator: Step) -> None:
        """Begins a step that no client requested."""
