"""The commands `go_back` and `tick_back`: an exact run is taken back to a moment, and paused there.

The run is made again from the newest snapshot before the moment, or from its begin, as fast as the machine
can; what came from outside enters at the same places. What was before the moment belongs to both runs; what
follows is a branch, with its own recording.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from msgspec import structs

from executor import child_messages, messages
from executor.child_messages import ApplicationReady, Fault, GoingBack, WentBack
from executor.session.debugger.holding import give_breakpoints
from executor.session.exact.branching import throw_away
from executor.session.exact.hosting import host
from executor.session.exact.snapshots import keep_present, ticks_of
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.running import hold_world, terminate_application
from executor.session.waits import Answered, Step, StepFailed, Wait, gone, is_spare_lost, taken

if TYPE_CHECKING:
    from collections.abc import Generator

    from msgspec import Struct

    from executor.replay_messages import Replay
    from executor.session.child import Child
    from executor.session.exact.past import PastRun
    from executor.session.stage import Stage

__all__ = ["LIVE_HINT", "found_run", "go_back", "refuse_by_hand", "tick_back"]

SILENT_S: Final = 60.0
SILENT_COPY_S: Final = 10.0
NO_RUN: Final = "There is no run to go back in."
NO_RUN_HINT: Final = "Press Run first."
UNKNOWN: Final = "This run cannot be made again: it is too long ago, or was in another world."
UNKNOWN_HINT: Final = "Go back in a later run."
BY_HAND: Final = (
    "The program was changed by hand with the Python debugger at {:.2f} s: "
    "from there on the run cannot be made again."
)
BY_HAND_HINT: Final = "Choose an earlier moment, or press Run."
BY_HAND_BEFORE: Final = (
    "The program was changed by hand before this run's world was reset: it cannot be made again."
)
LIVE: Final = "A live run has no way back by one tick: its world and its program are not one."
LIVE_HINT: Final = "Make the run exact in the menu beside Run, and press Run."
FIRST: Final = "This is the beginning of the run: there is no tick before."
RESET: Final = "The world was reset here: there is no tick before in this run."
BEAT_S: Final = 2.0


def go_back(stage: Stage, data: messages.GoBack) -> Step:
    """Takes the present run, or an earlier one in this world, back to a moment."""
    past = found_run(stage, data.run)
    refuse_by_hand(past, data.t)
    if stage.state in HAS_APPLICATION:
        yield from keep_present(stage)
        yield from terminate_application(stage, data)
    reached = yield from _to(stage, past, past.replay(data.t))
    text = f"World and program are back at {reached.t:.2f} s. Resume lets them run on from there."
    stage.output.emit(messages.Log("manager", "info", text, time=reached.t))


def tick_back(stage: Stage, data: Struct) -> Step:
    """Takes the present run back to the begin of its last whole tick.

    A branch that is a part of its parent is thrown away: else each press would leave one behind.
    """
    if stage.children.host is None:
        raise StepFailed("live_run", LIVE, LIVE_HINT)
    past = found_run(stage, "")
    if not _repeats_parent(stage, past, past.ticks):
        yield from keep_present(stage)  # it tells all ticks, too
    ticks = (yield from _whole_ticks(stage, past)) - 1
    if ticks < past.reset_ticks:
        raise StepFailed("first_tick", RESET if past.resets else FIRST)
    if past.by_hand_s is not None and ticks > past.by_hand_ticks:
        refuse_by_hand(past, None)
    yield from terminate_application(stage, data)
    is_repeated = _repeats_parent(stage, past, ticks + 1)  # the session has all its ticks now
    course = replace(past, run=past.parent) if is_repeated else past
    instead_of = past.run if is_repeated else ""
    reached = yield from _to(stage, course, course.replay(None, ticks), instead_of)
    if is_repeated:
        throw_away(stage, past.run)
    text = f"One tick back, to {reached.t:.2f} s: a step makes this tick again."
    stage.output.emit(messages.Log("manager", "info", text, time=reached.t))


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


def refuse_by_hand(past: PastRun, until_s: float | None) -> None:
    """Refuses a moment before which the debugger has changed the program of a run; None is its end.

    Raises:
        StepFailed: it is one.
    """
    if past.by_hand_s is not None and (until_s is None or until_s >= past.by_hand_s):
        if past.by_hand_s == 0 and past.resets:
            raise StepFailed("changed_by_hand", BY_HAND_BEFORE, "Press Run.")
        raise StepFailed("changed_by_hand", BY_HAND.format(past.by_hand_s), BY_HAND_HINT)


def _repeats_parent(stage: Stage, past: PastRun, whole: int) -> bool:
    """Returns whether a branch has in its whole ticks what its parent has, and nobody has marked it."""
    parent = stage.past.find(past.parent) if past.parent else None
    if parent is None or not past.is_part_of(parent, whole):
        return False
    is_named = any(branch.run == past.run and branch.name for branch in stage.mirror.branches)
    return not is_named and all(flag.run != past.run for flag in stage.mirror.flags.values())


def _whole_ticks(stage: Stage, past: PastRun) -> Generator[Wait, Any, int]:
    """Returns how many ticks of the present run have ended, also while it stands at a line of Python."""
    application = stage.children.get("application")
    if application is None or not stage.python.is_stopped:
        return past.ticks
    vitals, beats = application.vitals, application.vitals.beats
    late = "The program gives no sign of life."
    yield Wait(lambda: vitals.beats > beats or gone(application)(), BEAT_S, late)
    return vitals.ticks - 1


def _to(stage: Stage, past: PastRun, replay: Replay, instead_of: str = "") -> Answered[WentBack]:
    """Takes a run back, and says how far it is on its way; the branch may take the place of another."""
    stage.output.emit(messages.GoingBack(0.0))
    try:
        return (yield from _from_snapshot(stage, past, replay, instead_of))
    finally:
        stage.output.emit(messages.GoingBack(1.0))


def _from_snapshot(stage: Stage, past: PastRun, replay: Replay, instead_of: str) -> Answered[WentBack]:
    """Makes a run again from its newest snapshot before the moment; from its begin where that fails."""
    snapshot = stage.snapshots.newest(past, replay.until_s, ticks_of(replay))
    if snapshot is None:
        return (yield from _make_again(stage, past, replay, instead_of))
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
        return (yield from _make_again(stage, past, replay, instead_of))
    _take_over(stage, past, application, reached, instead_of)
    return reached


def _make_again(
    stage: Stage, past: PastRun, replay: Replay, instead_of: str, tries: int = 2
) -> Answered[WentBack]:
    """Makes a run again in a process of its own, and gives it the world; replaces a dead spare, once."""
    application = _start(stage, past, replay)
    try:
        reached = yield from _arrived(stage, application)
    except StepFailed as failure:
        if stage.children.get("application") is application:
            stage.children.drop("application")
        if tries > 1 and is_spare_lost(application, failure):
            return (yield from _make_again(stage, past, replay, instead_of, tries - 1))
        stage.children.replenish()
        raise
    _take_over(stage, past, application, reached, instead_of)
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


def _take_over(stage: Stage, past: PastRun, application: Child, reached: WentBack, instead_of: str) -> None:
    """Gives the branch the world, its views, and a recording; it stays paused."""
    stage.past.branch(past, reached, instead_of)
    stage.mirror.tick_hz = reached.tick_hz
    stage.sim_time_s = reached.t
    host(stage, application)
    stage.recording.begin(parent=past.run, from_t=reached.t)
    stage.past.name(stage.recording.run)
    give_breakpoints(stage)
    stage.enter(State.PAUSED)
    if (differs := application.said(child_messages.Differs)) is not None:
        _tell_differs(stage, differs)


def _tell_differs(stage: Stage, found: child_messages.Differs) -> None:
    stage.output.emit(messages.Differs(found.tick, found.t, found.cause))
    text = f"From tick {found.tick} on ({found.t:.2f} s) the run differs from the first time."
    hint = f"What is not repeated: {found.cause}."
    stage.output.emit(messages.Log("manager", "warning", f"{text} {hint}", time=found.t))
