"""The command `go_back` for live runs: the world goes back to a keyframe, and the tree begins again there.

What an action has in its fields is not recorded. So the program is loaded again, with the blackboard of the
keyframe; values that the recording does not hold are left empty, and named.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from msgspec import structs

from executor import child_messages, messages, recorder_messages
from executor.child_messages import ApplicationReady, Fault
from executor.session.debugger.holding import give_breakpoints
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.running import hold_world, terminate_application
from executor.session.waits import Answered, Step, StepFailed, Wait, confirmed, is_spare_lost, taken

if TYPE_CHECKING:
    from executor.recorder_messages import WorldKeyframe
    from executor.session.child import Child
    from executor.session.exact.past import PastRun
    from executor.session.stage import Stage

__all__ = ["go_back_live"]

FIND_S: Final = 20.0
LOAD_S: Final = 60.0


def go_back_live(stage: Stage, past: PastRun, t_s: float | None) -> Step:
    """Takes the world back to the last keyframe of a live run that is not later than a moment."""
    if past.refusal:
        raise StepFailed("not_repeatable", f"{past.refusal}: it cannot go back.", "Press Run.")
    found = yield from _keyframe(stage, past, t_s)
    if stage.state in HAS_APPLICATION:
        yield from terminate_application(stage, messages.Empty())
    hold_world(stage)
    order = stage.children.order("world", child_messages.LoadWorld(data=found.world))
    yield confirmed(order, "take its state back")
    stage.sim_time_s = found.t
    yield from _begin_again(stage, past, found)
    stage.recording.begin(parent=past.run, from_t=found.t)
    stage.past.name(stage.recording.run)
    give_breakpoints(stage)
    stage.enter(State.PAUSED)
    text = f"The world is back at {found.t:.2f} s. The tree begins again there, with the recorded blackboard."
    stage.output.emit(messages.Log("manager", "info", text, time=found.t))


def _keyframe(stage: Stage, past: PastRun, t_s: float | None) -> Answered[WorldKeyframe]:
    recorder = stage.children.get("recorder")
    if recorder is None or not past.run:
        raise StepFailed("not_recorded", "This run is not recorded, so its world cannot go back.")
    recorder.forget(recorder_messages.WorldKeyframe)
    order = stage.children.order("recorder", recorder_messages.FindKeyframe(run=past.run, t=t_s))
    yield confirmed(order, "find the moment", FIND_S)
    found = recorder.said(recorder_messages.WorldKeyframe)
    if found is None:
        raise StepFailed("not_recorded", "The recorder does not say how the world was.")
    return found


def _begin_again(stage: Stage, past: PastRun, found: WorldKeyframe, tries: int = 2) -> Step:
    """Loads the program as it was at the moment; replaces a dead spare, once."""
    application = _start(stage, past, found)
    try:
        late = "The application did not finish loading in time: a module or a setup() hangs."
        reply = yield Wait(taken(application, Fault, ApplicationReady), LOAD_S, late)
        if isinstance(reply, Fault):
            raise StepFailed("load_failed", reply.message, reply.hint)
    except StepFailed as failure:
        stage.past.drop_unborn()
        if stage.children.get("application") is application:
            stage.children.drop("application")
        if tries > 1 and is_spare_lost(application, failure):
            yield from _begin_again(stage, past, found, tries - 1)
            return
        stage.children.replenish()
        raise


def _start(stage: Stage, past: PastRun, found: WorldKeyframe) -> Child:
    stage.children.wants_exact = False
    stage.mirror.begin_run(past.start.tick_hz)
    application = stage.children.ensure("application")
    application.is_started = True
    stage.hold.since_s, stage.hold.given = None, stage.hold.breakpoints
    stage.hold.profile_given = stage.hold.profile
    stage.hold.groot2_given = stage.hold.groot2
    start = structs.replace(
        past.start,
        app_dir=past.folder_at(found.t),
        breakpoints=stage.hold.breakpoints,
        profile=stage.hold.profile,
        groot2=stage.hold.groot2,
        is_debugged=False,
        time_s=found.t,
        blackboard_json=found.blackboard_json,
    )
    stage.children.tell_application(start)
    stage.past.begin(structs.replace(start, time_s=None, blackboard_json=""))
    stage.nodes.start(stage, stage.run.plan)
    return application
