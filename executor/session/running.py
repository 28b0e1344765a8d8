"""What the commands do that concern a run that is under way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, cast

from executor import messages
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.waits import (
    NOT_ANSWERING,
    REPLY_TIMEOUT_S,
    Broken,
    Ended,
    Step,
    StepFailed,
    Wait,
    answered,
    confirmed,
    gone,
    message_of,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from msgspec import Struct

    from executor.session.child import Child
    from executor.session.protocol import Session

__all__ = [
    "await_tick",
    "go",
    "pause",
    "resume",
    "set_blackboard",
    "step",
    "stop_moving",
]

TICK_PATIENCE_S: Final = 1.0
ROUNDS_OF_PATIENCE: Final = 5
INTERRUPT_PATIENCE_S: Final = 1.0
_PLACE: Final = frozenset({"node_id", "tree_id", "node_path", "file", "traceback"})


def stop_moving(session: Session) -> None:
    """Freezes the world, with the robot at rest."""
    session.tell("world", "stop_robot")
    session.tell("world", "pause")


def go(session: Session, application: Child) -> Step:
    """Lets time pass in both processes."""
    application.forget("resumed")
    world = session.order("world", "resume")
    session.tell("application", "resume")
    yield confirmed(world, "resume")
    late = "The application did not resume in time."
    yield Wait(answered(application, "resumed"), REPLY_TIMEOUT_S, late)


def pause(session: Session, _: Struct) -> Step:
    """Stops ticks and simulated time together."""
    application = session.child("application")
    application.forget("paused")
    session.tell("application", "pause")
    world = session.order("world", "pause")
    failure = yield from await_tick(session, application, message_of(application, "paused"))
    if failure is not None:
        raise failure
    try:
        yield confirmed(world, "pause")
    except StepFailed:
        if session.state is State.APPLICATION_RUNNING:
            session.tell("application", "resume")  # time passes in both processes, or in none
        raise
    session.enter(State.PAUSED)


def await_tick(session: Session, application: Child, until: Callable[[], Any]) -> Ended:
    """Waits for what comes once the tick is over; one that hangs is ended, and why it failed is returned."""
    vitals = application.vitals
    for _ in range(ROUNDS_OF_PATIENCE):
        try:
            yield Wait(until, TICK_PATIENCE_S, "tick")
        except StepFailed as failure:
            if failure.code != "timeout":
                raise
            if not vitals.has_beaten or vitals.stuck_s >= TICK_PATIENCE_S:
                break  # else it is slow, as all is on a busy machine
        else:
            return None
    return (yield from end_hanging_tick(session, application))


def end_hanging_tick(session: Session, application: Child) -> Broken:
    """Breaks the tick off, so that the application names its node; kills it if that does not help.

    Returns why what waits for the tick has failed.
    """
    session.interrupt(application)
    try:
        yield Wait(
            lambda: application.said("finished") or gone(application)(), INTERRUPT_PATIENCE_S, "interrupt"
        )
    except StepFailed as failure:
        if failure.code != "timeout":
            raise
    reason = _tick_failure(application)
    if session.state in HAS_APPLICATION:
        if application.said("finished") is None:
            _tell_killed(session, application, reason)
        stop_moving(session)
        session.enter(State.VISUALIZATION_READY, reason.message)
    if session.children.get("application") is application:
        session.drop("application")
    session.replenish()
    return reason


def _tick_failure(application: Child) -> StepFailed:
    if application.vitals.is_frozen and application.said("finished") is None:
        why = application.hang or "The application does not answer: its process is frozen."
        return StepFailed(NOT_ANSWERING, why, "It was ended; press Run to start it again.")
    return StepFailed(
        "tick_hangs",
        f"The tick did not return within {TICK_PATIENCE_S:g} s and was ended.",
        "An action's update() must return soon; let it return RUNNING while work goes on.",
    )


def _tell_killed(session: Session, application: Child, failure: StepFailed) -> None:
    node = application.hanging_node
    message = f"The tick hung{f' in {node}' if node else ''}, and the application was killed."
    if failure.code == NOT_ANSWERING:
        message = failure.message
    if not application.hang:
        place = {k: str(v) for k, v in application.vitals.place.items() if k in _PLACE}
        line = int(application.vitals.place.get("line", 0))
        session.emit(messages.Fault("timeout", message, line=line, **place))
    session.emit(messages.Finished("IDLE", "process_died", message))


def resume(session: Session, _: Struct) -> Step:
    """Lets ticks and simulated time go on."""
    try:
        yield from go(session, session.child("application"))
    except StepFailed:
        if session.state is State.PAUSED:  # time passes in both processes, or in none
            session.tell("application", "pause")
            session.tell("world", "pause")
        raise
    session.enter(State.APPLICATION_RUNNING)


def step(session: Session, _: Struct) -> Step:
    """Ticks once, and lets the time of one tick pass."""
    application = session.child("application")
    application.forget("stepped")
    session.tell("application", "step")
    try:
        yield Wait(message_of(application, "stepped", "finished"), REPLY_TIMEOUT_S, "tick")
    except StepFailed as failure:
        if failure.code != "timeout":
            raise
        raise (yield from end_hanging_tick(session, application)) from None
    if session.state is State.PAUSED:
        yield confirmed(session.order("world", "step", dt_s=1.0 / session.mirror.tick_hz), "step")


def set_blackboard(session: Session, data: Struct) -> Step:
    """Writes an entry of the blackboard."""
    data = cast("messages.SetBlackboard", data)
    application = session.child("application")
    application.forget("blackboard_set")
    session.tell("application", "set_blackboard", scope=data.scope, key=data.key, value=data.value)
    late = "The application did not answer in time."
    reply = yield Wait(message_of(application, "blackboard_set"), REPLY_TIMEOUT_S, late)
    if reply.get("error"):
        raise StepFailed("bad_data", str(reply["error"]))
