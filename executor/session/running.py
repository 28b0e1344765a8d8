"""Steps of the commands for a loaded application: pause, resume, step, and writing the blackboard."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor import child_messages, messages
from executor.child_messages import BlackboardSet, Finished, Held, Paused, Resumed, Stepped
from executor.session.debugger.holding import settle
from executor.session.debugger.python import HELD_IN_PYTHON, HELD_IN_PYTHON_HINT, HELD_IN_PYTHON_TEXT
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
    from executor.session.stage import Stage

__all__ = [
    "await_tick",
    "begun",
    "go",
    "hold_world",
    "pause",
    "resume",
    "retire",
    "set_blackboard",
    "step",
    "stop_moving",
    "terminate_application",
]

TICK_PATIENCE_S: Final = 1.0
ROUNDS_OF_PATIENCE: Final = 5
INTERRUPT_PATIENCE_S: Final = 1.0
RETIRE_GRACE_S: Final = 2.0


def stop_moving(stage: Stage) -> None:
    """Sets the robot's target velocity to zero and pauses the world."""
    stage.children.tell_world(child_messages.StopRobot())
    stage.children.tell_world(child_messages.Pause())
    stage.run.is_world_alone = False


def hold_world(stage: Stage) -> None:
    """Pauses a world that runs without an application."""
    if stage.run.is_world_alone:
        stop_moving(stage)


def go(stage: Stage, application: Child) -> Step:
    """Resumes simulated time and ticks, in both processes."""
    application.forget(Resumed)
    world = stage.children.order("world", child_messages.Resume())
    stage.children.tell_application(child_messages.Resume())
    yield confirmed(world, "resume")
    late = "The application did not resume in time."
    yield Wait(answered(application, Resumed), REPLY_TIMEOUT_S, late)


def begun(stage: Stage, application: Child) -> None:
    """Enters the state of a run whose time passes, or the one after it: its first tick may have ended it.

    Raises:
        StepFailed: the application died meanwhile.
    """
    if application.said(Finished) is not None:
        retire(stage, application)
    elif application.is_alive:
        settle(stage, application)
    else:
        raise StepFailed("process_died", f"The application {application.exit_reason}.")


def retire(stage: Stage, application: Child) -> None:
    """Leaves the state of a run that ended by itself, and lets its process end."""
    stop_moving(stage)
    if stage.children.get("application") is application:
        stage.children.drop("application", grace_s=RETIRE_GRACE_S, reason="finished its run")
    finished = application.said(Finished)
    message = finished.message if finished is not None else ""
    stage.enter(State.VISUALIZATION_READY, message or "The run ended.")
    stage.children.replenish()


def pause(stage: Stage, _: Struct) -> Step:
    """Pauses ticks and simulated time together; a held tree is stopped already."""
    if stage.state is State.HELD:
        return
    application = stage.children.ensure("application")
    python = stage.python
    application.forget(Paused)
    stage.children.tell_application(child_messages.Pause())
    world = stage.children.order("world", child_messages.Pause())
    paused = message_of(application, Paused)
    failure = yield from await_tick(stage, application, lambda: python.is_stopped or paused())
    if failure is not None:
        raise failure
    try:
        yield confirmed(world, "pause")
    except StepFailed:
        if stage.state is State.APPLICATION_RUNNING:
            # Time must pass in both processes, or in neither.
            stage.children.tell_application(child_messages.Resume())
        raise
    if python.is_stopped:
        python.pauses = True
    elif not application.is_holding:
        stage.enter(State.PAUSED)


def await_tick(stage: Stage, application: Child, until: Callable[[], Any]) -> Ended:
    """Waits for a message that follows the current tick.

    If the tick hangs, ends it and returns the failure.
    """
    vitals = application.vitals
    for _ in range(ROUNDS_OF_PATIENCE):
        try:
            yield Wait(until, TICK_PATIENCE_S, "tick")
        except StepFailed as failure:
            if failure.code != "timeout":
                raise
            if not vitals.has_beaten or vitals.stuck_s >= TICK_PATIENCE_S:
                break  # while there is progress, the tick is only slow, as on a busy machine
        else:
            return None
    return (yield from end_hanging_tick(stage, application))


def end_hanging_tick(stage: Stage, application: Child) -> Broken:
    """Interrupts a tick that hangs, so that the application reports the node.

    Kills the application if that fails.

    Returns the failure for the command that waits for the tick.
    """
    stage.children.interrupt(application)
    try:
        yield Wait(
            lambda: application.said(Finished) or gone(application)(), INTERRUPT_PATIENCE_S, "interrupt"
        )
    except StepFailed as failure:
        if failure.code != "timeout":
            raise
    reason = _tick_failure(application)
    if stage.state in HAS_APPLICATION:
        if application.said(Finished) is None:
            _tell_killed(stage, application, reason)
        stop_moving(stage)
        stage.enter(State.VISUALIZATION_READY, reason.message)
    if stage.children.get("application") is application:
        stage.children.drop("application")
    stage.children.replenish()
    return reason


def _tick_failure(application: Child) -> StepFailed:
    if application.vitals.is_frozen and application.said(Finished) is None:
        why = application.hang or "The application does not answer: its process is frozen."
        return StepFailed(NOT_ANSWERING, why, "It was ended; press Run to start it again.")
    return StepFailed(
        "tick_hangs",
        f"The tick did not return within {TICK_PATIENCE_S:g} s and was ended.",
        "An action's update() must return soon; let it return RUNNING while work continues.",
    )


def _tell_killed(stage: Stage, application: Child, failure: StepFailed) -> None:
    node = application.hanging_node
    message = f"The tick hung{f' in {node}' if node else ''}, and the application was killed."
    if failure.code == NOT_ANSWERING:
        message = failure.message
    if not application.hang:
        at = application.vitals.place
        place = (at.node_id, at.tree_id, at.node_path, at.file, at.line, at.traceback)
        stage.output.emit(messages.Fault("timeout", message, "", *place))
    stage.output.emit(messages.Finished("IDLE", "process_died", message))


def resume(stage: Stage, _: Struct) -> Step:
    """Resumes ticks and simulated time."""
    application = stage.children.ensure("application")
    try:
        yield from go(stage, application)
    except StepFailed:
        if stage.state is State.PAUSED:  # time must pass in both processes, or in neither
            stage.children.tell_application(child_messages.Pause())
            stage.children.tell_world(child_messages.Pause())
        raise
    begun(stage, application)


def step(stage: Stage, _: Struct) -> Step:
    """Ticks once, and simulates the time of one tick period."""
    application = stage.children.ensure("application")
    application.forget(Stepped)
    application.forget(Held)
    stage.children.tell_application(child_messages.StepTick())
    try:
        done = message_of(application, Stepped, Finished, Held)
        yield Wait(lambda: stage.python.is_stopped or done(), REPLY_TIMEOUT_S, "tick")
    except StepFailed as failure:
        if failure.code != "timeout":
            raise
        raise (yield from end_hanging_tick(stage, application)) from None
    if stage.state is State.PAUSED:
        yield confirmed(
            stage.children.order("world", child_messages.StepWorld(1.0 / stage.mirror.tick_hz)), "step"
        )


def set_blackboard(stage: Stage, data: messages.SetBlackboard) -> Step:
    """Writes an entry of the blackboard."""
    if stage.python.is_stopped:
        raise StepFailed(HELD_IN_PYTHON, HELD_IN_PYTHON_TEXT, HELD_IN_PYTHON_HINT)
    application = stage.children.ensure("application")
    application.forget(BlackboardSet)
    stage.children.tell_application(child_messages.SetBlackboard(data.scope, data.key, data.value))
    late = "The application did not answer in time."
    reply = yield Wait(message_of(application, BlackboardSet), REPLY_TIMEOUT_S, late)
    if reply.error:
        raise StepFailed("bad_data", reply.error)


def terminate_application(stage: Stage, _: Struct) -> Step:
    """Ends the application; the world stays, paused."""
    if stage.state not in HAS_APPLICATION:
        hold_world(stage)
        return
    application = stage.children.ensure("application")
    application.is_stopping = True
    stage.children.tell_application(child_messages.Stop())
    stage.python.let_go()
    stop_moving(stage)
    yield from await_tick(stage, application, gone(application))
