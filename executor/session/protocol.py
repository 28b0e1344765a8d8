"""The session as a state machine without I/O: events in, effects out, time as an argument.

`Session.handle` takes one event of `executor.session.events` and returns the effects that it asks for. What a
command does in which state is in `ladder.TABLE`; what its steps are is in `steps`.
A step that takes time is a generator that says what it waits for, so every other event is answered
meanwhile; one step goes on at a time, and `cancel` and `disconnect` end it early.
"""

from __future__ import annotations

import contextlib
import logging
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

import msgspec
from msgspec import Struct

from executor import messages
from executor.session import child_events, child_exits, immediate, steps, streaming, watch
from executor.session.child import Child
from executor.session.clients import Clients
from executor.session.events import (
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
    Interrupt,
    Kill,
    Kind,
    Retire,
    Send,
    Spawn,
    StreamClosed,
    StreamOpened,
    StreamPaced,
    Tell,
    TimePassed,
    Unpack,
    Unpacked,
)
from executor.session.ladder import HAS_APPLICATION, TABLE, State, is_legal, where
from executor.session.launch_nodes import LaunchNodes
from executor.session.mirror import Mirror
from executor.session.questions import ANSWER_S, Questions
from executor.session.waits import NOT_ANSWERING, StepFailed, Wait

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Mapping

    from executor.session.questions import Question
    from executor.session.waits import Step

__all__ = ["About", "Session"]

_log = logging.getLogger(__name__)

_EVENT_NAMES: Final = {kind: name for name, kind in messages.EVENTS.items()}
_CLIMBING: Final = frozenset({"launch_universe", "run_application", "run", "restart_application"})
RETIRE_GRACE_S: Final = 2.0


@dataclass(frozen=True)
class About:
    """What does not change during a session."""

    version: str
    ros_distro: str = "jazzy"
    ros_domain_id: int = 0
    ros_environment: Mapping[str, str] = field(default_factory=dict)
    outside_domain_id: int = 0
    grace_s: float = 300.0
    promote_s: float = 5.0


@dataclass
class _Job:
    """The step that goes on, for the client and request to be answered at its end."""

    command: str
    askers: list[tuple[str, str]]
    steps: Generator[Wait, Any, None]
    wait: Wait | None = None
    deadline_s: float = 0.0


@dataclass
class _Counters:
    child: int = 0
    archive: int = 0
    unpacked: dict[int, Unpacked] = field(default_factory=dict)


class Session:
    """One session: its ladder, its clients, and what is known of its two child processes."""

    def __init__(self, about: About, *, now_s: float = 0.0) -> None:
        self.about = about
        self.mirror = Mirror()
        self.clients = Clients(now_s)
        self.children: dict[Kind, Child] = {}
        self.leaving: set[tuple[Kind, int]] = set()
        self.spares_lost: Counter[Kind] = Counter()
        self.run = steps.LastRun()
        self.sim_time_s = 0.0
        self._now_s = now_s
        self._effects: list[Effect] = []
        self._job: _Job | None = None
        self._count = _Counters()
        self.questions = Questions()
        self.nodes = LaunchNodes()
        self.renderer = ""
        self.has_tf = False

    # --- what the adapter calls -------------------------------------------------------------------

    @property
    def state(self) -> State:
        """The rung on which the ladder stands."""
        return self.mirror.state

    @property
    def deadline_s(self) -> float | None:
        """When `TimePassed` is due at the latest, if nothing else happens."""
        times = [self.clients.deadline_s(self.about.grace_s, self.about.promote_s)]
        times.append(self.questions.deadline_s)
        if self._job is not None:
            times.append(self._job.deadline_s)
        return min((t for t in times if t is not None), default=None)

    def prestart(self) -> list[Effect]:
        """Starts both processes ahead of the first command, since their imports take time."""
        self.replenish()
        return self._take_effects()

    def handle(self, event: Event, now_s: float) -> list[Effect]:
        """Takes an event and returns what is to be done, in order."""
        self._now_s = now_s
        self._dispatch(event)
        self._advance()
        self._expire()
        if "application" not in self.children or not self.children["application"].is_started:
            self.nodes.stop(self)
        return self._take_effects()

    # --- what the steps use -----------------------------------------------------------------------

    def enter(self, state: State, reason: str = "") -> None:
        """Moves the ladder: the one place where its state changes."""
        _log.info("%s -> %s %s", self.state, state, reason)
        if not state.reaches(State.UNIVERSE_READY):
            self.renderer, self.has_tf = "", False
        self.emit(messages.StateChanged(state.value, reason))

    def send(self, client: str, event: Struct, request: str | None = None) -> None:
        """Sends an event to one client."""
        self._effects.append(Send(client, _EVENT_NAMES[type(event)], event, request))

    def emit(self, event: Struct) -> None:
        """Sends an event to all clients and remembers it for those that come later."""
        self.mirror.apply(event)
        self._effects.append(Send(None, _EVENT_NAMES[type(event)], event))

    def effect(self, effect: Effect) -> None:
        """Asks for something to be done."""
        self._effects.append(effect)

    def next_number(self) -> int:
        """Returns the number of a new child."""
        self._count.child += 1
        return self._count.child

    def child(self, kind: Kind) -> Child:
        """Returns the living child of a kind, and starts it where there is none."""
        if kind not in self.children:
            self.children[kind] = Child(kind, self.next_number(), self._now_s)
            self._effects.append(Spawn(kind, self._count.child))
        return self.children[kind]

    def replenish(self) -> None:
        """Has a process of each kind ready for what may come next."""
        self.child("world")
        self.child("application")

    def tell(self, kind: Kind, type_: str, **fields: Any) -> None:
        """Sends a message to the living child of a kind, if there is one."""
        if kind in self.children:
            self._effects.append(Tell(kind, self.children[kind].number, {"type": type_, **fields}))

    def ask(  # noqa: PLR0913 - one question
        self,
        kind: Kind,
        event: CommandCame,
        fields: dict[str, Any] | None = None,
        *,
        type_: str = "",
        patience_s: float = ANSWER_S,
        then: Callable[[], None] | None = None,
    ) -> None:
        """Has the child of a kind answer a command; `then` is done when it did what it was asked."""
        child, fields = self.children.get(kind), fields or {}
        if child is None:
            self.refuse(event, "process_died", f"The {kind} is gone.")
            return
        topic = str(fields.get("topic", ""))
        if child.is_hanging:
            if topic:
                self.clients.echo(event.client, topic, 0.0)
            self.refuse(event, NOT_ANSWERING, child.hang)
            return
        token = self.questions.add(
            event.client,
            event.request,
            (kind, child.number),
            self._now_s,
            topic=topic,
            patience_s=patience_s,
            then=then,
        )
        self.tell(kind, type_ or event.command, request=token, **fields)

    def order(self, kind: Kind, type_: str, **fields: Any) -> tuple[Child, str]:
        """Has a child confirm what it is told; returns it, and the token that its answer will have."""
        child, token = self.child(kind), self.questions.token()
        child.expect(token)
        self.tell(kind, type_, request=token, **fields)
        return child, token

    def answer(self, question: Question, error: messages.Error | None) -> None:
        """Answers a command whose child has answered, or cannot any more."""
        if error is None:
            if question.then is not None:
                question.then()
            self._ack(question.client, question.request)
            return
        if question.topic:
            self.clients.echo(question.client, question.topic, 0.0)
        self.send(question.client, error, question.request)

    def interrupt(self, child: Child) -> None:
        """Has the child's tick broken off."""
        self._effects.append(Interrupt(child.kind, child.number))

    def drop(self, kind: Kind, *, grace_s: float = 0.0, reason: str = "was ended") -> None:
        """Ends the child of a kind: now, or when it had time to end by itself."""
        child = self.children.pop(kind, None)
        if child is None:
            return
        child.end(reason)  # whoever waits for it waits no more
        self.answer_late(self.questions.orphaned((kind, child.number)), "process_died", reason)
        self.leaving.add((kind, child.number))
        if grace_s:
            self._effects.append(Tell(kind, child.number, {"type": "stop"}))
            self._effects.append(Retire(kind, child.number, grace_s))
        else:
            self._effects.append(Kill(kind, child.number))

    def unpack(self, archive_base64: str) -> Callable[[], Unpacked | None]:
        """Has an archive unpacked; returns a function that tells the result once it is there."""
        self._count.archive += 1
        token = self._count.archive
        self._effects.append(Unpack(token, archive_base64))
        return lambda: self._count.unpacked.get(token)

    def open_streams(self) -> None:
        """Asks the world for all that the clients want to see."""
        for client, data in self.clients.wanted_streams():
            self.subscribe(client, data)

    def subscribe(self, client: str, data: messages.Subscribe) -> None:
        """Asks the world for one stream."""
        self.tell("world", "subscribe", client=client, **msgspec.to_builtins(data))

    def resume_echoes(self) -> None:
        """Asks the world for the topics that the clients listen to, as soon as they are there."""
        for topic, max_hz in self.clients.echoes().items():
            self.tell("world", "echo_topic", topic=topic, max_hz=max_hz, patient=True)

    def close_streams(self) -> None:
        """Asks the world to send nothing more."""
        for client, data in self.clients.wanted_streams():
            self.tell("world", "unsubscribe", client=client, stream=data.stream)

    # --- events -----------------------------------------------------------------------------------

    def _dispatch(self, event: Event) -> None:
        match event:
            case ClientJoined():
                self.clients.join(event.client)
                self.introspect(event.client)
                self.send(event.client, self.mirror.snapshot())
                self.resume_echoes()
            case ClientLeft():
                for topic in self.clients.leave(event.client, self._now_s):
                    self.tell("world", "echo_topic", topic=topic, max_hz=0.0)
            case StreamOpened() | StreamClosed() | StreamPaced():
                streaming.heard(self, event)
            case CommandCame():
                self._on_command(event)
            case ChildSaid():
                self._on_message(event)
            case ChildLooked():
                watch.looked(self, event, self._now_s)
            case ChildTraced():
                watch.traced(self, event)
            case ChildExited():
                child_exits.exited(self, event)
            case Unpacked():
                self._count.unpacked = {event.token: event}
            case TimePassed():
                pass

    def introspect(self, client: str) -> None:
        """Tells a client what the session is, and whether it drives."""
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
        self.send(client, payload)

    def know_world(self, renderer: str, *, has_tf: bool) -> None:
        """The world says what it can do; clients that were told otherwise are told again."""
        if (renderer, has_tf) == (self.renderer, self.has_tf):
            return
        self.renderer, self.has_tf = renderer, has_tf
        for client in self.clients.here():
            self.introspect(client)

    def _on_message(self, event: ChildSaid) -> None:
        if event.kind == "node":
            self.nodes.said(self, event)
            return
        child = self.children.get(event.kind)
        if child is None or child.number != event.number:
            if event.message["type"] == "log":
                child_events.forward(self, event)  # the last words of a child that was let go
            return
        child.note(event.message)
        child_events.hear(self, event)
        self._after_forward(child, event.message)

    def _after_forward(self, child: Child, message: dict[str, Any]) -> None:
        """The application ended by itself: the ladder goes down, the process is let go."""
        if message["type"] == "finished" and self.state in HAS_APPLICATION and not child.is_stopping:
            steps.stop_moving(self)
            self.drop(child.kind, grace_s=RETIRE_GRACE_S, reason="finished its run")
            self.enter(State.VISUALIZATION_READY, str(message.get("message") or "The run ended."))
            self.replenish()
        elif message["type"] == "fault" and message.get("kind") == "timeout":
            self.tell("world", "stop_robot")

    # --- commands ---------------------------------------------------------------------------------

    def _on_command(self, event: CommandCame) -> None:
        row = TABLE[event.command]
        if not row.for_viewers and self.clients.role(event.client) != "driver":
            self.refuse(event, "not_driver", "Another client drives this session.", "Take over to drive it.")
        elif event.command == "cancel":
            self._cancel()
            self._ack(event.client, event.request)
        elif event.command == "disconnect":
            self._disconnect(event)
        elif self._job is not None and row.is_step:
            self._join_or_refuse(self._job, event)
        elif not is_legal(self.state, event.command):
            message = f"{event.command} is not possible in {self.state}."
            self.refuse(event, "wrong_state", message, f"It is in: {where(event.command)}.")
        elif row.is_step:
            self._begin(event)
        else:
            immediate.ACTIONS[event.command](self, event)
            if event.command not in immediate.ANSWER_LATER:
                self._ack(event.client, event.request)

    def _begin(self, event: CommandCame) -> None:
        generator = steps.STEPS[event.command](self, event.data)
        self._job = _Job(event.command, [(event.client, event.request)], generator)

    @property
    def is_free(self) -> bool:
        """Whether no step is going on."""
        return self._job is None

    def begin_own(self, command: str, generator: Step) -> None:
        """Begins a step that no client asked for."""
        self._job = _Job(command, [], generator)

    def _join_or_refuse(self, job: _Job, event: CommandCame) -> None:
        if job.command == event.command and event.command.startswith("terminate_"):
            job.askers.append((event.client, event.request))
            return
        self.refuse(event, "busy", f"{job.command} is going on.", "Wait for it, or send cancel.")

    def _disconnect(self, event: CommandCame) -> None:
        if self._job is not None and self._job.command == "disconnect":
            self._job.askers.append((event.client, event.request))
            return
        self._cancel(also_bounded=True)
        self._begin(event)

    def _cancel(self, *, also_bounded: bool = False) -> None:
        """Ends the step that goes on; those that end by themselves soon are left alone."""
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
        """Lets the step go on as far as it can."""
        while (job := self._job) is not None:
            try:
                if not self._resume(job):
                    return
            except StopIteration:
                self._job = None
                for client, request in job.askers:
                    self._ack(client, request)
            except StepFailed as failure:
                self._job = None
                self._fail(job, failure)

    def _resume(self, job: _Job) -> bool:
        """Resumes the generator if what it waits for is there; tells whether it moved."""
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
                elif self._now_s >= job.deadline_s:
                    job.wait = job.steps.throw(StepFailed("timeout", job.wait.too_late))
                else:
                    return False
        job.deadline_s = self._now_s + job.wait.timeout_s
        return True

    def answer_late(self, questions: list[Question], code: str, reason: str, why: str = "") -> None:
        """Answers commands whose child will not."""
        for question in questions:
            text = why or f"The {question.child[0]} {reason}."
            self.answer(question, messages.Error(code, text))

    def _expire(self) -> None:
        self.answer_late(self.questions.expired(self._now_s), "timeout", "did not answer in time")
        for client in self.clients.promote(self._now_s, self.about.promote_s):
            self.introspect(client)
        if self.clients.is_abandoned(self._now_s, self.about.grace_s):
            self._effects.append(EndSession("no client came back within the grace period"))

    def _ack(self, client: str, request: str) -> None:
        self.send(client, messages.Ack(), request)

    def _fail(self, job: _Job, failure: StepFailed) -> None:
        payload = messages.Error(failure.code, failure.message, failure.hint)
        if not job.askers:
            self.emit(messages.Log("manager", "error", f"{failure.message} {failure.hint}".strip()))
        for client, request in job.askers:
            self.send(client, payload, request)

    def refuse(self, event: CommandCame, code: str, message: str, hint: str = "") -> None:
        """Answers a command with an error."""
        self.send(event.client, messages.Error(code, message, hint), event.request)

    def _take_effects(self) -> list[Effect]:
        effects, self._effects = self._effects, []
        return effects
