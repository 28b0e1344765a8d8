"""The session as a state machine without I/O: events in, effects out, time as an argument.

`Session.handle` takes one event of `executor.session.events` and returns the effects. `ladder.TABLE` says in
which states a command is legal; `steps` and `immediate` implement the commands. A command that takes time is
a step: a generator that yields the conditions for which it waits, so that other events are handled meanwhile.
Only one step runs at a time; `cancel` and `disconnect` end it early.
"""

from __future__ import annotations

import contextlib
import logging
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Protocol

from executor import child_messages, messages
from executor.child_messages import Fault, Finished
from executor.session import child_events, child_exits, immediate, running, steps, streaming
from executor.session.children import Children
from executor.session.clients import Clients
from executor.session.debugger import attaching, holding
from executor.session.debugger.python import PythonDebugger
from executor.session.evaluation.evaluating import Evaluating
from executor.session.events import (
    AttachWanted,
    ChildExited,
    ChildLooked,
    ChildSaid,
    ChildTraced,
    ClientJoined,
    ClientLeft,
    CommandCame,
    Effect,
    EndSession,
    Event,
    RecordingWanted,
    SnapshotEnded,
    SnapshotWeighed,
    StreamClosed,
    StreamOpened,
    StreamPaced,
    Unpack,
    Unpacked,
)
from executor.session.exact import hosting
from executor.session.exact.past import PastRuns
from executor.session.exact.snapshots import Snapshots
from executor.session.exact.sources import Sources
from executor.session.exact.trying import Trying
from executor.session.hangs import waiting, watch
from executor.session.ladder import HAS_APPLICATION, TABLE, State, is_legal, where
from executor.session.launch_nodes import LaunchNodes
from executor.session.mirror import Mirror
from executor.session.output import Output
from executor.session.questions import Questions, answer_late
from executor.session.runs.recording import Recording
from executor.session.stage import About, LastRun
from executor.session.waits import StepFailed, Wait

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from msgspec import Struct

    from executor.session.child import Child
    from executor.session.events import Kind
    from executor.session.waits import Step

__all__ = ["Session"]

_log = logging.getLogger(__name__)

_CLIMBING: Final = frozenset(
    {"launch_universe", "run_application", "run", "restart_application", "go_back", "tick_back"}
)


@dataclass
class _Job:
    """The step in progress, and the clients and requests that are answered at its end."""

    command: str
    askers: list[tuple[str, str]]
    steps: Generator[Wait, Any, None]
    wait: Wait | None = None
    deadline_s: float = 0.0


class _Owner(Protocol):
    """A part of the session that has the children of a kind to itself."""

    def said(self, event: ChildSaid) -> None:
        """Handles a message of such a child."""

    def exited(self, event: ChildExited) -> None:
        """Handles the end of such a child."""


class Session:
    """One session: its ladder, its clients and its child processes."""

    def __init__(self, about: About, *, now_s: float = 0.0) -> None:
        self.about = about
        self.now_s = now_s
        self.mirror = Mirror()
        self.output = Output(self.mirror)
        self.clients = Clients(now_s + about.patience_s)
        self.questions = Questions()
        self.children = Children(self.output.effect, lambda: self.now_s, self.questions.token, self._lost)
        self.run = LastRun()
        self.past = PastRuns()
        self.snapshots = Snapshots(self)
        self.hold = holding.Hold()
        self.attaching: attaching.Attaching | None = None
        self.python = PythonDebugger(self)
        self.recording = Recording(self)
        self.output.record = self.recording.tell
        self.evaluating = Evaluating(self)
        self.trying = Trying(self)
        self.sources = Sources(self)
        self._owners: dict[Kind, _Owner] = {
            "recorder": self.recording,
            "evaluation": self.evaluating,
            "trying": self.trying,
            "source": self.sources,
            "adapter": self.python,
        }
        self.sim_time_s = 0.0
        self._job: _Job | None = None
        self._archives = 0
        self._unpacked: Unpacked | None = None
        self.nodes = LaunchNodes()
        self.renderer = ""
        self.has_tf = False

    @property
    def state(self) -> State:
        """The state of the ladder."""
        return self.mirror.state

    @property
    def deadline_s(self) -> float | None:
        """The latest time at which the session must receive `TimePassed`, if nothing else happens.

        None if there is none.
        """
        times = [self.clients.deadline_s(self.about.grace_s, self.about.promote_s)]
        times += [self.questions.deadline_s, holding.deadline_s(self)]
        if self._job is not None:
            times.append(self._job.deadline_s)
        return min((t for t in times if t is not None), default=None)

    def prestart(self) -> list[Effect]:
        """Starts world and application before the first command, since their imports take time."""
        self.children.replenish()
        return self.output.take()

    def handle(self, event: Event, now_s: float) -> list[Effect]:
        """Handles an event and returns its effects, in order."""
        self.now_s = now_s
        self._dispatch(event)
        self._advance()
        self._expire()
        self.python.follow()
        repeatable = messages.RepeatableRuns(self.past.names, self.past.live_names, self.past.by_hand)
        if repeatable != self.mirror.repeatable:
            self.output.emit(repeatable)
        application = self.children.get("application")
        if application is None or not application.is_started:
            self.nodes.stop(self)
        return self.output.take()

    def enter(self, state: State, reason: str = "") -> None:
        """Changes the state of the ladder; no other function does."""
        _log.info("%s -> %s %s", self.state, state, reason)
        if not state.reaches(State.UNIVERSE_READY):
            self.renderer, self.has_tf = "", False
            self.past.forget()
            self.snapshots.forget()
        self.output.emit(messages.StateChanged(state.value, reason))

    def snapshot(self) -> messages.Snapshot:
        """Returns the complete state, for a client that joins late or was too slow."""
        application = self.children.get("application")
        return self.mirror.snapshot(hanging_s=application.hanging_s if application is not None else 0.0)

    def unpack(self, archive_base64: str) -> Callable[[], Unpacked | None]:
        """Orders an archive to be unpacked.

        Returns a function that returns the result, or None before it exists.
        """
        self._archives += 1
        token = self._archives
        world = self.run.world
        needed = {self.run.folder, world.assets if world is not None else "", *self.past.folders}
        self.output.effect(Unpack(token, archive_base64, frozenset(needed - {""})))
        return lambda: (
            self._unpacked if self._unpacked is not None and self._unpacked.token == token else None
        )

    def _dispatch(self, event: Event) -> None:
        match event:
            case ClientJoined():
                self.clients.join(event.client, event.user)
                self.introspect(event.client)
                self.output.send(event.client, self.snapshot())
                streaming.resume_echoes(self)
            case ClientLeft():
                streaming.leave(self, event.client)
            case StreamOpened() | StreamClosed() | StreamPaced():
                streaming.take(self, event)
            case CommandCame():
                self._on_command(event)
            case ChildSaid():
                self._on_message(event)
            case ChildLooked():
                watch.looked(self, event, self.now_s)
            case ChildTraced():
                watch.traced(self, event)
            case ChildExited():
                self._on_exit(event)
            case Unpacked():
                self._unpacked = event
            case _:
                self._on_wanted(event)

    def _on_wanted(self, event: Event) -> None:
        match event:
            case AttachWanted():
                target = attaching.Attaching(event.address, event.folder)
                self.begin_own("attach", steps.attach(self, target))
            case RecordingWanted():
                self.recording.start(event.folder, is_whole=event.is_whole)
            case SnapshotEnded():
                self.snapshots.ended(event)
            case SnapshotWeighed():
                self.snapshots.weighed(event)
            case _:
                pass

    def introspect(self, client: str) -> None:
        """Sends a client the properties of the session and its role in it."""
        payload = messages.Introspection(
            protocol=messages.PROTOCOL,
            client_id=client,
            role=self.clients.role(client),
            state=self.state.value,
            version=self.about.version,
            ros_distro=self.about.ros_distro,
            ros_domain_id=self.about.ros_domain_id,
            renderer=self.renderer,
            tf=self.has_tf,
            ros_environment=dict(self.about.ros_environment),
        )
        self.output.send(client, payload)

    def know_world(self, renderer: str, *, has_tf: bool) -> None:
        """Stores the capabilities of the world, and notifies clients of a change.

        These are its renderer, and whether it publishes tf.
        """
        if (renderer, has_tf) == (self.renderer, self.has_tf):
            return
        self.renderer, self.has_tf = renderer, has_tf
        for client in self.clients.here():
            self.introspect(client)

    def _on_exit(self, event: ChildExited) -> None:
        self.children.leaving.discard((event.kind, event.number))
        if event.kind == "node":
            self.nodes.exited(self, event)
        elif (owner := self._owners.get(event.kind)) is not None:
            owner.exited(event)
        else:
            child_exits.exited(self, event)

    def _on_message(self, event: ChildSaid) -> None:
        if event.kind == "node":
            self.nodes.said(self, event)
            return
        if (owner := self._owners.get(event.kind)) is not None:
            owner.said(event)
            return
        child = self.children.of(event)
        if child is None:
            child_events.log(self, event)  # the last lines of a child that was dropped
            return
        child.note(event.message)
        if event.kind == "application":
            self.python.beat(child)
            waiting.beat(self, child)
        child_events.forward(self, child, event)
        self._after_forward(child, event.message)

    def _after_forward(self, child: Child, message: Struct) -> None:
        """Leaves the state of a running application after the run, and stops the robot when a tick hangs."""
        if isinstance(message, Finished) and self.state in HAS_APPLICATION and not child.is_stopping:
            running.retire(self, child)
            if self.is_free:
                self._attach_again()
        elif isinstance(message, child_messages.Entered | child_messages.Fingerprints):
            self.past.said(message)
        elif isinstance(message, child_messages.SnapshotTaken | child_messages.NoSnapshots):
            self.snapshots.said(child, message)
        elif isinstance(message, child_messages.WorldState):
            hosting.give_back(self, child, message.data)
        elif isinstance(message, Fault) and message.kind == "timeout":
            self.children.tell_world(child_messages.StopRobot())

    def _attach_again(self) -> None:
        """Follows the attached program again, which was started again."""
        if self.attaching is not None and self.state is State.VISUALIZATION_READY:
            self.begin_own("restart_application", steps.restart_application(self, messages.Empty()))

    def _on_command(self, event: CommandCame) -> None:
        row = TABLE[event.command]
        if not row.for_viewers and self.clients.role(event.client) != "driver":
            self.output.refuse(
                event, "not_driver", "Another window controls this session.", "Take over to control it."
            )
        elif (refused := attaching.refusal(self, event.command)) is not None:
            self.output.refuse(event, *refused)
        elif event.command == "cancel":
            self._cancel()
            self._ack(event.client, event.request)
        elif event.command == "disconnect":
            self._disconnect(event)
        elif self._job is not None and row.is_step:
            self._join_or_refuse(self._job, event)
        elif not is_legal(self.state, event.command):
            message = f"{event.command} is not possible in {self.state}."
            self.output.refuse(event, "wrong_state", message, f"It is in: {where(event.command)}.")
        elif row.is_step:
            self._begin(event)
        else:
            immediate.IMMEDIATE[event.command](self, event)
            if event.command not in immediate.ANSWER_LATER:
                self._ack(event.client, event.request)

    def _begin(self, event: CommandCame) -> None:
        generator = steps.STEPS[event.command](self, event.data)
        self._job = _Job(event.command, [(event.client, event.request)], generator)

    @property
    def is_free(self) -> bool:
        """Whether no step is in progress."""
        return self._job is None

    def begin_own(self, command: str, generator: Step) -> None:
        """Begins a step that no client requested."""
        self._job = _Job(command, [], generator)

    def _join_or_refuse(self, job: _Job, event: CommandCame) -> None:
        if job.command == event.command and event.command.startswith("terminate_"):
            job.askers.append((event.client, event.request))
            return
        self.output.refuse(event, "busy", f"{job.command} is under way.", "Wait for it, or send cancel.")

    def _disconnect(self, event: CommandCame) -> None:
        if self._job is not None and self._job.command == "disconnect":
            self._job.askers.append((event.client, event.request))
            return
        self._cancel(also_bounded=True)
        self._begin(event)

    def _cancel(self, *, also_bounded: bool = False) -> None:
        """Ends the step in progress if it climbs the ladder.

        All other steps have short timeouts; they are ended only if `also_bounded` is set.
        """
        if self._job is None or not (also_bounded or self._job.command in _CLIMBING):
            return
        job, self._job = self._job, None
        failure = StepFailed("cancelled", f"{job.command} was cancelled.")
        if job.wait is not None:
            with contextlib.suppress(StepFailed, StopIteration):
                job.steps.throw(failure)
        job.steps.close()
        self._fail(job, failure)

    def _advance(self) -> None:
        """Resumes the step in progress until it has to wait again."""
        while (job := self._job) is not None:
            try:
                if not self._resume(job):
                    return
            except StopIteration:
                self._job = None
                for client, request in job.askers:
                    self._ack(client, request)
                if job.command in ("attach", "restart_application"):
                    self._attach_again()
            except StepFailed as failure:
                self._job = None
                self._fail(job, failure)

    def _resume(self, job: _Job) -> bool:
        """Resumes a step if its wait is over; returns whether it did."""
        if job.wait is None:
            job.wait = next(job.steps)
        else:
            try:
                value = job.wait.until()
            except StepFailed as failure:
                job.wait = job.steps.throw(failure)
            else:
                if value is not None:
                    job.wait = job.steps.send(value)
                elif self.python.is_stopped:
                    job.deadline_s = self.now_s + job.wait.timeout_s
                    return False
                elif self.now_s >= job.deadline_s:
                    job.wait = job.steps.throw(StepFailed("timeout", job.wait.too_late))
                else:
                    return False
        job.deadline_s = self.now_s + job.wait.timeout_s
        return True

    def _lost(self, child: Child, reason: str) -> None:
        hosting.give_back(self, child)
        answer_late(self, self.questions.orphaned(child.key), "process_died", reason)

    def _expire(self) -> None:
        answer_late(self, self.questions.expired(self.now_s), "timeout", "did not answer in time")
        holding.expire(self)
        for client in self.clients.promote(self.now_s, self.about.promote_s):
            self.introspect(client)
        if self.clients.is_abandoned(self.now_s, self.about.grace_s):
            self.output.effect(EndSession("no client reconnected within the grace period"))

    def _ack(self, client: str, request: str) -> None:
        self.output.send(client, messages.Ack(), request)

    def _fail(self, job: _Job, failure: StepFailed) -> None:
        payload = messages.Error(failure.code, failure.message, failure.hint)
        if not job.askers:
            self.output.emit(messages.Log("manager", "error", f"{failure.message} {failure.hint}".strip()))
        for client, request in job.askers:
            self.output.send(client, payload, request)
