"""State of the running tree and world, for the snapshot of a client that joins late.

`Mirror.apply` receives every event that is sent to clients; `Mirror.snapshot` is the state that a client has
after all these events.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Final

from msgspec import structs

from executor.messages import (
    Attached,
    AttachedTree,
    Blackboard,
    BlackboardEntry,
    Branch,
    Fault,
    Finished,
    FlagSet,
    Forced,
    Groot2,
    Held,
    HeldInPython,
    LaunchNode,
    LaunchNodes,
    Log,
    NodeStatus,
    PortSet,
    Profile,
    RecordingStopped,
    Released,
    RepeatableRuns,
    Segment,
    Sim,
    Snapshot,
    StateChanged,
    Tick,
    TopicMismatch,
    Tree,
    Waiting,
)
from executor.session.ladder import State

if TYPE_CHECKING:
    from msgspec import Struct

__all__ = ["Mirror"]

LOG_LINES: Final = 500
FAULTS: Final = 50
ENTRIES: Final = 5000
MISMATCHES: Final = 50
STOPS: Final = 20
BRANCHES: Final = 100
SMOOTHING: Final = 0.1


class Mirror:
    """The state of a session as its clients see it."""

    def __init__(self) -> None:
        self.state = State.IDLE
        self.tree: Tree | None = None
        self.statuses: dict[int, NodeStatus] = {}
        self.held: Held | None = None
        self.held_in_python: HeldInPython | None = None
        self.forced: Forced | None = None
        self.attached: Attached | None = None
        self.attached_tree: AttachedTree | None = None
        self.profile: Profile | None = None
        self.groot2: Groot2 | None = None
        self.waiting = Waiting()
        self.past: list[tuple[int, NodeStatus]] = []
        self.finished: Finished | None = None
        self.ports: dict[tuple[str, str, str], PortSet] = {}
        self.blackboard: dict[tuple[str, str], BlackboardEntry] = {}
        self.logs: deque[Log] = deque(maxlen=LOG_LINES)
        self.launch_nodes: list[LaunchNode] = []
        self.faults: deque[Fault] = deque(maxlen=FAULTS)
        self.mismatches: deque[TopicMismatch] = deque(maxlen=MISMATCHES)
        self.tick = 0
        self.tick_ms = 0.0
        self.tick_hz = 0.0
        self.speed = 1.0
        self.real_time_factor = 0.0
        self.universe = ""
        self.segments: dict[tuple[str, int, int], Segment] = {}
        self.flags: dict[str, FlagSet] = {}
        self.stops: deque[RecordingStopped] = deque(maxlen=STOPS)
        self.branches: deque[Branch] = deque(maxlen=BRANCHES)
        self.repeatable = RepeatableRuns([])
        self.runs = 0
        self._logged = 0
        self._run_starts: deque[tuple[int, int]] = deque(maxlen=LOG_LINES)

    def begin_run(self, tick_hz: float) -> None:
        """Removes the state of the previous run, and separates its output from the next run's."""
        self.tree = None
        self.statuses.clear()
        self.past = []
        self.finished = None
        self.held = self.held_in_python = self.forced = self.profile = None
        self.ports.clear()
        self.blackboard.clear()
        self.faults.clear()
        self.tick = 0
        self.tick_ms = 0.0
        self.tick_hz = tick_hz
        self.runs += 1
        self._run_starts.append((self._logged, self.runs))

    def apply(self, event: Struct) -> None:  # noqa: C901, PLR0912, PLR0915 - one line an event
        """Updates the state by one event that is sent to all clients."""
        match event:
            case StateChanged():
                self._enter(State(event.state))
            case Tree():
                self._apply_tree(event)
            case Tick():
                self._apply_tick(event)
            case Finished():
                self.finished = event
            case Blackboard():
                self._apply_entries(event.entries)
            case PortSet():
                self.ports[event.path, event.node_id, event.port] = event
            case Log():
                self.logs.append(event)
                self._logged += 1
            case LaunchNodes():
                self.launch_nodes = event.nodes
                self._forget_faults_of(event.nodes)
            case Fault():
                self.faults.append(event)
            case TopicMismatch():
                self._apply_mismatch(event)
            case Segment():
                self._apply_segment(event)
            case FlagSet():
                self._apply_flag(event)
            case RecordingStopped():
                self.stops.append(event)
            case Branch():
                self._apply_branch(event)
            case RepeatableRuns():
                self.repeatable = event
            case Held():
                self.held, self.held_in_python = event, None
            case HeldInPython():
                self.held_in_python = event
            case Released():
                self.held = None
            case Forced():
                self.forced = event if event.nodes or event.alone else None
            case Attached():
                self.attached = event
            case AttachedTree():
                self.attached_tree = event
            case Groot2():
                self.groot2 = event
            case Waiting():
                self.waiting = event
            case Profile():
                self.profile = event
            case Sim():
                self.speed = event.speed
                self.real_time_factor = event.real_time_factor

    def tick_load(self) -> tuple[float, float]:
        """Returns the mean duration of the last ticks, and the time available for one, in ms."""
        return self.tick_ms, 1000.0 / self.tick_hz if self.tick_hz else 0.0

    def snapshot(self, hanging_s: float = 0.0) -> Snapshot:
        """Returns the complete state, which a client needs before the following events.

        Args:
            hanging_s: how long the present tick has hung.
        """
        return Snapshot(
            state=self.state.value,
            tree=self.tree,
            statuses=list(self.statuses.items()),
            blackboard=list(self.blackboard.values()),
            logs=list(self.logs),
            faults=list(self.faults),
            tick_hz=self.tick_hz,
            speed=self.speed,
            universe=self.universe,
            launch_nodes=self.launch_nodes,
            mismatches=list(self.mismatches),
            past=self.past,
            finished=self.finished,
            runs=self.runs,
            run_starts=self._starts(),
            hanging_s=hanging_s,
            ports=list(self.ports.values()),
            segments=list(self.segments.values()),
            flags=list(self.flags.values()),
            stops=list(self.stops),
            branches=list(self.branches),
            repeatable_runs=self.repeatable.runs,
            live_runs=self.repeatable.live,
            runs_by_hand=self.repeatable.by_hand,
            held=self.held,
            held_in_python=self.held_in_python,
            forced=self.forced,
            attached=self.attached,
            attached_tree=self.attached_tree,
            profile=self.profile,
            groot2=self.groot2,
            waiting=self.waiting,
        )

    def _starts(self) -> list[tuple[int, int]]:
        """Returns the positions in the stored lines at which runs began."""
        dropped = self._logged - len(self.logs)
        return [(at - dropped, run) for at, run in self._run_starts if at >= dropped]

    def _enter(self, state: State) -> None:
        self.state = state
        self.waiting = Waiting()  # it is of one tick, which has ended or is held
        if state is not State.HELD:
            self.held_in_python = None
        if state is not State.HELD and not state.reaches(State.APPLICATION_RUNNING):
            self.held = self.forced = None
            if self.profile is not None:
                self.profile = structs.replace(self.profile, on=False)
        if not state.reaches(State.UNIVERSE_READY):
            self.mismatches.clear()

    def _apply_tree(self, event: Tree) -> None:
        self.tree = event
        self.statuses = {node.uid: "IDLE" for node in event.nodes}

    def _apply_tick(self, event: Tick) -> None:
        self.held_in_python = None
        self.tick = event.n
        self.tick_ms += (event.duration_ms - self.tick_ms) * (SMOOTHING if self.tick > 1 else 1.0)
        self.statuses.update(event.changed)
        self.past = event.past

    def _apply_segment(self, event: Segment) -> None:
        key = event.run, event.branch, event.number
        if event.bytes:
            self.segments[key] = event
        else:
            self.segments.pop(key, None)
        # A later run is recorded again, so what was missed before it is not shown any more.
        runs = {run for run, _, _ in self.segments}
        self.stops = deque((stop for stop in self.stops if stop.run in runs), maxlen=STOPS)

    def _apply_branch(self, event: Branch) -> None:
        others = [branch for branch in self.branches if branch.run != event.run]
        at = next((n for n, branch in enumerate(self.branches) if branch.run == event.run), len(others))
        self.branches = deque(
            [*others[:at], *([] if event.is_gone else [event]), *others[at:]], maxlen=BRANCHES
        )

    def _apply_flag(self, event: FlagSet) -> None:
        if any(flag.run != event.run for flag in self.flags.values()):
            self.flags.clear()
        if event.text:
            self.flags[event.id] = event
        else:
            self.flags.pop(event.id, None)

    def _apply_mismatch(self, event: TopicMismatch) -> None:
        found = structs.replace(event, resolved=False)
        if event.resolved and found in self.mismatches:
            self.mismatches.remove(found)
        elif not event.resolved and found not in self.mismatches:
            self.mismatches.append(found)

    def _forget_faults_of(self, nodes: list[LaunchNode]) -> None:
        """Removes the faults of launch nodes that run again."""
        places = {(node.file, node.line) for node in nodes if node.state == "running"}
        gone = [f for f in self.faults if f.kind == "process" and f.file and (f.file, f.line) in places]
        for fault in gone:
            self.faults.remove(fault)

    def _apply_entries(self, entries: list[BlackboardEntry]) -> None:
        for entry in entries:
            key = (entry.scope, entry.key)
            if entry.removed:
                self.blackboard.pop(key, None)
            elif key in self.blackboard or len(self.blackboard) < ENTRIES:
                self.blackboard[key] = entry
