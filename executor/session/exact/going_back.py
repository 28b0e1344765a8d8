"""The command `go_back`: world and program of an exact run are taken back to a moment, and held there.

The run is made again from the newest snapshot before the moment, or from its begin, as fast as the machine
can; what came from outside enters at the same places. What was before the moment belongs to both runs; what
follows is a branch, with its own recording.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from msgspec import structs

from executor import child_messages, messages
from executor.child_messages import ApplicationReady, Fault, GoingBack, WentBack
from executor.session.debugger.holding import give_breakpoints
from executor.session.exact.hosting import host
from executor.session.exact.snapshots import keep_present
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.running import hold_world, terminate_application
from executor.session.waits import Answered, Step, StepFailed, Wait, is_spare_lost, taken

if TYPE_CHECKING:
    from executor.replay_messages import Replay
    from executor.session.child import Child
    from executor.session.exact.past import PastRun
    from executor.session.stage import Stage

__all__ = ["found_run", "go_back"]

SILENT_S: Final = 60.0
SILENT_COPY_S: Final = 10.0
NO_RUN: Final = "There is no run to go back in."
NO_RUN_HINT: Final = "Press Run first."
UNKNOWN: Final = "This run cannot be made again: it is too long ago, or was in another world."
UNKNOWN_HINT: Final = "Go back in a later run."


def go_back(stage: Stage, data: messages.GoBack) -> Step:
    """Takes the present run, or an earlier one in this world, back to a moment."""
    past = found_run(stage, data.run)
    if stage.state in HAS_APPLICATION:
        yield from keep_present(stage)
        yield from terminate_application(stage, data)
    stage.output.emit(messages.GoingBack(0.0))
    try:
        reached = yield from _from_snapshot(stage, past, past.replay(data.t))
    finally:
        stage.output.emit(messages.GoingBack(1.0))
    _tell(stage, reached)


def found_run(stage: Stage, run: str) -> PastRun:
    """Returns a run of the session that can be made again, the present or last one for "".

    Raises:
        StepFailed: there is none.
    """
    past = stage.past.find(run)
    if past is None:
        if run and stage.past.find("") is not None:
            raise StepFailed("unknown_run", UNKNOWN, UNKNOWN_HINT)
        raise StepFailed("no_run", NO_RUN, NO_RUN_HINT)
    if past.refusal:
        raise StepFailed("not_repeatable", f"{past.refusal}: it cannot be made again.", "Press Run.")
    return past


def _from_snapshot(stage: Stage, past: PastRun, replay: Replay) -> Answered[WentBack]:
    """Makes a run again from its newest snapshot before the moment; from its begin where that fails."""
    snapshot = stage.snapshots.newest(past, replay.until_s)
    if snapshot is None:
        return (yield from _make_again(stage, past, replay))
    _prepare(stage, past)
    application = stage.children.wake(snapshot)
    stage.hold.profile_given = None
    stage.children.tell_exact(application, child_messages.Awake(replay, stage.mirror.speed))
    try:
        reached = yield from _arrived(stage, application, SILENT_COPY_S)
    except StepFailed as failure:
        if stage.children.get("application") is application:
            stage.children.drop("application")
        if failure.code in ("cancelled", "load_failed"):
            stage.children.replenish()
            raise
        text = f"A snapshot cannot be used: {failure} The run is made again from its begin."
        stage.output.emit(messages.Log("manager", "info", text))
        return (yield from _make_again(stage, past, replay))
    _take_over(stage, past, application, reached)
    return reached


def _make_again(stage: Stage, past: PastRun, replay: Replay, tries: int = 2) -> Answered[WentBack]:
    """Makes a run again in a process of its own, and gives it the world; replaces a dead spare, once."""
    application = _start(stage, past, replay)
    try:
        reached = yield from _arrived(stage, application)
    except StepFailed as failure:
        if stage.children.get("application") is application:
            stage.children.drop("application")
        if tries > 1 and is_spare_lost(application, failure):
            return (yield from _make_again(stage, past, replay, tries - 1))
        stage.children.replenish()
        raise
    _take_over(stage, past, application, reached)
    return reached


def _prepare(stage: Stage, past: PastRun) -> None:
    hold_world(stage)
    stage.children.wants_exact = True
    stage.mirror.begin_run(past.start.tick_hz)
    stage.hold.since_s, stage.hold.given = None, None  # it has those of the moment
    stage.hold.groot2_given = 0  # it looks from the moment on, when the run resumes


def _start(stage: Stage, past: PastRun, replay: Replay) -> Child:
    _prepare(stage, past)
    application = stage.children.ensure("application")
    application.is_started = True
    stage.hold.profile_given = stage.hold.profile
    assert past.start.world is not None  # noqa: S101 - an exact run has one
    stage.children.tell_application(
        structs.replace(
            past.start,
            replay=replay,
            is_debugged=False,
            groot2=0,
            profile=stage.hold.profile,
            world=structs.replace(past.start.world, speed=stage.mirror.speed),
        )
    )
    return application


def _arrived(stage: Stage, application: Child, silent_s: float = SILENT_S) -> Answered[WentBack]:
    """Waits for a run on its way; each sign of its progress gives it more time."""
    until = taken(application, Fault, ApplicationReady, GoingBack)
    late = "The run could not be made again in time: it no longer makes progress."
    while not isinstance(reply := (yield Wait(until, silent_s, late)), ApplicationReady):
        if isinstance(reply, Fault):
            raise StepFailed("load_failed", reply.message, reply.hint)
        application.forget(GoingBack)
        stage.output.emit(messages.GoingBack(reply.fraction))
    reached = application.said(WentBack)
    if reached is None:
        raise StepFailed("not_answering", "The run does not say where it is.")
    return reached


def _take_over(stage: Stage, past: PastRun, application: Child, reached: WentBack) -> None:
    """Gives the branch the world, its views, and a recording; it stays paused."""
    stage.past.branch(past, reached)
    stage.mirror.tick_hz = reached.tick_hz
    stage.sim_time_s = reached.t
    host(stage, application)
    stage.recording.begin(parent=past.run, from_t=reached.t)
    stage.past.name(stage.recording.run)
    give_breakpoints(stage)
    stage.enter(State.PAUSED)
    if (differs := application.said(child_messages.Differs)) is not None:
        _tell_differs(stage, differs)


def _tell(stage: Stage, reached: WentBack) -> None:
    text = f"World and program are back at {reached.t:.2f} s. Resume lets them run on from there."
    stage.output.emit(messages.Log("manager", "info", text, time=reached.t))


def _tell_differs(stage: Stage, found: child_messages.Differs) -> None:
    stage.output.emit(messages.Differs(found.tick, found.t, found.cause))
    text = f"From tick {found.tick} on ({found.t:.2f} s) the run differs from the first time."
    hint = f"What is not repeated: {found.cause}."
    stage.output.emit(messages.Log("manager", "warning", f"{text} {hint}", time=found.t))
