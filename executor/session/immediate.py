"""Commands that are not steps: they take no time, or a child answers them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeVar

from msgspec import Struct

from executor import child_messages, messages, recorder_messages
from executor.session import streaming
from executor.session.clients import MOST_ECHOED_BY_VIEWER, MOST_STREAMS
from executor.session.debugger.python import HELD_IN_PYTHON, HELD_IN_PYTHON_HINT, HELD_IN_PYTHON_TEXT
from executor.session.exact import branching
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.questions import ANSWER_S
from executor.session.runs.recording import FlagRefused
from executor.session.steps import RESET_TIMEOUT_S
from executor.session.waits import NOT_ANSWERING

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.child_messages import Request
    from executor.recorder_messages import ReadSegment
    from executor.session.child import Child
    from executor.session.events import CommandCame, Kind
    from executor.session.stage import Stage

__all__ = ["ANSWER_LATER", "IMMEDIATE"]

Data = TypeVar("Data", bound=Struct)


def _ask(  # noqa: PLR0913 - one question
    stage: Stage,
    event: CommandCame,
    kind: Kind,
    message: Request | ReadSegment,
    *,
    topic: str = "",
    patience_s: float = ANSWER_S,
    then: Callable[[], None] | None = None,
    refused: Callable[[], None] | None = None,
    late: Callable[[], None] | None = None,
) -> bool:
    """Forwards a command to a child; the child's answer becomes the reply (`Question`).

    The client counts as echoing `topic`, unless the child refuses. Returns False if no child can take the
    command, which is then refused at once.
    """
    child = stage.children.holder(kind)
    if child is None:
        stage.output.refuse(event, "process_died", f"The {kind} is gone.")
        return False
    if child is stage.children.get("application") and stage.python.is_stopped:
        stage.output.refuse(event, HELD_IN_PYTHON, HELD_IN_PYTHON_TEXT, HELD_IN_PYTHON_HINT)
        return False
    if child.is_hanging:
        if topic:
            stage.clients.echo(event.client, topic, 0.0)
        stage.output.refuse(event, NOT_ANSWERING, child.hang)
        return False
    token = stage.questions.add(
        event.client,
        event.request,
        child.key,
        stage.now_s,
        topic=topic,
        patience_s=patience_s,
        then=then,
        refused=refused,
        late=late,
    )
    stage.children.ask(kind, message, token)
    return True


def _running(stage: Stage) -> Child | None:
    """Returns the application that can take a command; None before it is loaded, and once it is to end."""
    application = stage.children.get("application")
    if application is None or application.is_stopping or stage.state not in HAS_APPLICATION:
        return None
    return application


def _set_tick_rate(stage: Stage, event: CommandCame, data: messages.SetTickRate) -> None:
    def note() -> None:
        stage.mirror.tick_hz = data.tick_hz

    _ask(stage, event, "application", child_messages.SetTickRate(data.tick_hz), then=note)


def _set_port(stage: Stage, event: CommandCame, data: messages.SetPort) -> None:
    message = child_messages.SetPort(node_id=data.node_id, path=data.path, port=data.port, value=data.value)
    _ask(stage, event, "application", message)


def _set_breakpoints(stage: Stage, event: CommandCame, data: messages.SetBreakpoints) -> None:
    """Keeps them for this run and those to come, also where the application dies before it takes them."""
    hold = stage.hold
    hold.breakpoints = data
    application = _running(stage)

    def note() -> None:
        hold.given = data

    def undo() -> None:
        if hold.breakpoints is data:
            hold.breakpoints = hold.given
            if hold.given is not None and hold.given is hold.given_late:
                tell(hold.given)  # it may have refused those, too

    def tell(wanted: messages.SetBreakpoints) -> None:
        stage.children.tell_application(child_messages.SetBreakpoints(wanted=wanted))

    def late() -> None:
        note()
        hold.given_late = data
        if hold.breakpoints is data and stage.children.get("application") is application:
            tell(data)  # it takes the good ones, and names the others in the log

    if application is not None and not (stage.python.is_stopped or application.is_hanging):
        message = child_messages.SetBreakpoints(wanted=data)
        _ask(stage, event, "application", message, then=note, refused=undo, late=late)
        return
    if application is not None:  # it takes them when it continues
        note()
        tell(data)
    stage.output.send(event.client, messages.Ack(), event.request)


def _going(step: child_messages.DebugStep) -> Callable[[Stage, CommandCame, messages.Empty], None]:
    def go(stage: Stage, event: CommandCame, _: messages.Empty) -> None:
        _ask(stage, event, "application", child_messages.Continue(step=step))

    return go


def _step_to(stage: Stage, event: CommandCame, data: messages.StepTo) -> None:
    _ask(stage, event, "application", child_messages.Continue(step="to", uid=data.uid, path=data.path))


def _force(stage: Stage, event: CommandCame, data: messages.Force) -> None:
    _ask(stage, event, "application", child_messages.ForceResult(force=data))


def _release(stage: Stage, event: CommandCame, data: messages.Release) -> None:
    _ask(stage, event, "application", child_messages.ReleaseForced(uid=data.uid))


def _control(stage: Stage, event: CommandCame, data: messages.Control) -> None:
    attaching = stage.attaching
    assert attaching is not None  # noqa: S101 - other sessions refuse the command

    def note() -> None:
        attaching.controls = data.on

    if _running(stage) is not None:
        _ask(stage, event, "application", child_messages.Control(on=data.on), then=note)
        return
    note()
    stage.output.send(event.client, messages.Ack(), event.request)


def _profile(stage: Stage, event: CommandCame, data: messages.SetProfile) -> None:
    profile = messages.SetProfile(on=data.on)  # a leaf is one of this run's tree

    def note() -> None:
        stage.hold.profile = stage.hold.profile_given = profile

    if _running(stage) is not None:
        _ask(stage, event, "application", child_messages.MeasureNodes(wanted=data), then=note)
        return
    stage.hold.profile = profile
    stage.output.send(event.client, messages.Ack(), event.request)


def _serve_groot2(stage: Stage, event: CommandCame, data: messages.ServeGroot2) -> None:
    if not stage.about.ros_environment:
        text = "This session is isolated from other programs, so Groot2 cannot reach it."
        stage.output.refuse(event, "isolated", text)
        return

    def note() -> None:
        stage.hold.groot2 = stage.hold.groot2_given = data.port
        stage.output.emit(messages.Groot2(data.port))

    if _running(stage) is not None:
        _ask(stage, event, "application", child_messages.ServeGroot2(port=data.port), then=note)
        return
    stage.hold.groot2 = data.port
    stage.output.emit(messages.Groot2(data.port))
    stage.output.send(event.client, messages.Ack(), event.request)


def _dap(stage: Stage, event: CommandCame, data: messages.Dap) -> None:
    stage.python.ask(event, data)


def _set_speed(stage: Stage, event: CommandCame, data: messages.SetSpeed) -> None:
    def note() -> None:
        stage.mirror.speed = data.speed

    _ask(stage, event, "world", child_messages.SetSpeed(data.speed), then=note)


def _reset_world(stage: Stage, event: CommandCame, _: Struct) -> None:
    if not _ask(stage, event, "world", child_messages.Reset(), patience_s=RESET_TIMEOUT_S):
        return
    stage.recording.begin(resets=True)  # now, so that the world begins it at its first moment
    if stage.state in HAS_APPLICATION:
        stage.past.reset(stage.recording.run)


def _run_world(stage: Stage, event: CommandCame, _: Struct) -> None:
    def note() -> None:
        stage.run.is_world_alone = stage.state is State.VISUALIZATION_READY

    _ask(stage, event, "world", child_messages.Resume(), then=note)


def _does_time_pass(stage: Stage) -> bool:
    """Returns whether simulated time passes; the session cannot stop the time of an outside graph."""
    run = stage.run
    return stage.state is State.APPLICATION_RUNNING or run.is_world_alone or run.is_outside


def _subscribe(stage: Stage, event: CommandCame, data: messages.Subscribe) -> None:
    if stage.clients.subscribes_to_too_many(event.client, data):
        text = f"A page may watch {MOST_STREAMS} streams at once."
        stage.output.refuse(event, "too_many", text, "Close the view of another camera first.")
        return
    stage.clients.subscribe(event.client, data)
    if stage.clients.has_stream(event.client) and stage.state.reaches(State.VISUALIZATION_READY):
        streaming.subscribe(stage, event.client, data)


def _unsubscribe(stage: Stage, event: CommandCame, data: messages.Unsubscribe) -> None:
    stage.clients.unsubscribe(event.client, data.stream, data.sensor)
    streaming.unsubscribe(stage, event.client, data.stream, data.sensor)


def _teleop(stage: Stage, _: CommandCame, data: messages.Teleop) -> None:
    # A pause freezes tree and world. A world that only waits for an application runs while a client drives.
    goes_on = stage.state in (State.UNIVERSE_READY, State.VISUALIZATION_READY)
    stage.children.tell_world(child_messages.Teleop(data.linear, data.angular, goes_on))


def _move_body(stage: Stage, event: CommandCame, data: messages.MoveBody) -> None:
    _ask(stage, event, "world", child_messages.MoveBody(data.id, data.pose))


def _list_topics(stage: Stage, event: CommandCame, _: Struct) -> None:
    _ask(stage, event, "world", child_messages.ListTopics())


def _publish_topic(stage: Stage, event: CommandCame, data: messages.PublishTopic) -> None:
    if not _does_time_pass(stage):
        hint = "Resume the run first." if stage.state is State.PAUSED else "Let the world run first."
        stage.output.refuse(event, "world_paused", "The world is paused, so nothing would happen.", hint)
        return
    message = child_messages.PublishTopic(data.topic, data.type, data.message)
    _ask(stage, event, "world", message, topic=data.topic)


def _describe_type(stage: Stage, event: CommandCame, data: messages.DescribeType) -> None:
    _ask(stage, event, "world", child_messages.DescribeType(data.type))


def _echo_topic(stage: Stage, event: CommandCame, data: messages.EchoTopic) -> None:
    if data.max_hz > 0 and stage.clients.echoes_too_many(event.client, data.topic):
        text = f"A viewer may echo {MOST_ECHOED_BY_VIEWER} topics at once."
        stage.output.refuse(event, "too_many", text, "End the echo of another topic first, or take over.")
        return
    rate_hz = stage.clients.echo(event.client, data.topic, data.max_hz)
    _ask(stage, event, "world", child_messages.EchoTopic(data.topic, rate_hz), topic=data.topic)


def _restart_node(stage: Stage, event: CommandCame, data: messages.RestartNode) -> None:
    problem = stage.nodes.restart(stage, data.id)
    if problem:
        stage.output.refuse(event, "unknown_node", problem)
    else:
        stage.output.send(event.client, messages.Ack(), event.request)


def _read_recording(stage: Stage, event: CommandCame, data: messages.ReadRecording) -> None:
    if not stage.clients.has_stream(event.client):
        stage.output.refuse(event, "no_stream", "Open the stream socket first: the data come there.")
        return
    if stage.children.get("recorder") is None:
        stage.output.refuse(event, "not_recorded", "This session is not recorded.")
        return
    message = recorder_messages.ReadSegment(
        client=event.client,
        run=data.run,
        segment=data.segment,
        version=data.version,
        offset=data.offset,
        length=data.length,
    )
    _ask(stage, event, "recorder", message)


def _flag(stage: Stage, event: CommandCame, data: messages.Flag) -> None:
    try:
        stage.recording.flag(data, stage.clients.user(event.client))
    except FlagRefused as refused:
        stage.output.refuse(event, refused.code, refused.message, refused.hint)
    else:
        stage.output.send(event.client, messages.Ack(), event.request)


def _evaluate(stage: Stage, event: CommandCame, data: messages.Evaluate) -> None:
    stage.evaluating.begin(event, data)


def _try(stage: Stage, event: CommandCame, data: messages.TryValues | messages.TrySeeds) -> None:
    stage.trying.begin(event, data)


def _stop_trying(stage: Stage, _: CommandCame, data: messages.StopTrying) -> None:
    stage.trying.stop(data.job)


def _source_of_tick(stage: Stage, event: CommandCame, data: messages.SourceOfTick) -> None:
    stage.sources.begin(event, data)


def _stop_source(stage: Stage, _: CommandCame, data: messages.StopSource) -> None:
    stage.sources.stop(data.job)


def _take_over(stage: Stage, event: CommandCame, _: Struct) -> None:
    for client in stage.clients.take_over(event.client):
        stage.introspect(client)


def _ping(_: Stage, __: CommandCame, ___: Struct) -> None:
    """Does nothing: the acknowledgement is the answer."""


def _typed(
    kind: type[Data], handler: Callable[[Stage, CommandCame, Data], None]
) -> Callable[[Stage, CommandCame], None]:
    def handle(stage: Stage, event: CommandCame) -> None:
        if not isinstance(event.data, kind):
            raise TypeError(f"{kind.__name__} expected, not {type(event.data).__name__}")
        handler(stage, event, event.data)

    return handle


IMMEDIATE: Final[dict[str, Callable[[Stage, CommandCame], None]]] = {
    "set_tick_rate": _typed(messages.SetTickRate, _set_tick_rate),
    "set_port": _typed(messages.SetPort, _set_port),
    "set_breakpoints": _typed(messages.SetBreakpoints, _set_breakpoints),
    "continue_run": _typed(messages.Empty, _going("continue")),
    "step_into": _typed(messages.Empty, _going("into")),
    "step_over": _typed(messages.Empty, _going("over")),
    "step_out": _typed(messages.Empty, _going("out")),
    "step_to": _typed(messages.StepTo, _step_to),
    "force": _typed(messages.Force, _force),
    "release": _typed(messages.Release, _release),
    "profile": _typed(messages.SetProfile, _profile),
    "serve_groot2": _typed(messages.ServeGroot2, _serve_groot2),
    "dap": _typed(messages.Dap, _dap),
    "set_speed": _typed(messages.SetSpeed, _set_speed),
    "reset_world": _typed(messages.Empty, _reset_world),
    "run_world": _typed(messages.Empty, _run_world),
    "subscribe": _typed(messages.Subscribe, _subscribe),
    "unsubscribe": _typed(messages.Unsubscribe, _unsubscribe),
    "echo_topic": _typed(messages.EchoTopic, _echo_topic),
    "publish_topic": _typed(messages.PublishTopic, _publish_topic),
    "move_body": _typed(messages.MoveBody, _move_body),
    "list_topics": _typed(messages.Empty, _list_topics),
    "describe_type": _typed(messages.DescribeType, _describe_type),
    "restart_node": _typed(messages.RestartNode, _restart_node),
    "control": _typed(messages.Control, _control),
    "teleop": _typed(messages.Teleop, _teleop),
    "read_recording": _typed(messages.ReadRecording, _read_recording),
    "flag": _typed(messages.Flag, _flag),
    "branches": _typed(messages.Empty, branching.branches),
    "name_branch": _typed(messages.NameBranch, branching.name_branch),
    "drop_branch": _typed(messages.DropBranch, branching.drop_branch),
    "evaluate": _typed(messages.Evaluate, _evaluate),
    "try_values": _typed(messages.TryValues, _try),
    "try_seeds": _typed(messages.TrySeeds, _try),
    "stop_trying": _typed(messages.StopTrying, _stop_trying),
    "source_of_tick": _typed(messages.SourceOfTick, _source_of_tick),
    "stop_source": _typed(messages.StopSource, _stop_source),
    "take_over": _typed(messages.Empty, _take_over),
    "ping": _typed(messages.Empty, _ping),
}

ANSWER_LATER: Final = frozenset(
    {
        "set_tick_rate",
        "set_port",
        "set_breakpoints",
        "continue_run",
        "step_into",
        "step_over",
        "step_out",
        "step_to",
        "force",
        "release",
        "control",
        "profile",
        "serve_groot2",
        "dap",
        "set_speed",
        "reset_world",
        "run_world",
        "move_body",
        "list_topics",
        "echo_topic",
        "publish_topic",
        "describe_type",
        "restart_node",
        "read_recording",
        "flag",
        "name_branch",
        "drop_branch",
        "evaluate",
        "try_values",
        "try_seeds",
        "source_of_tick",
    }
)
"""Commands that are not acknowledged immediately: the handler or a child answers later."""
