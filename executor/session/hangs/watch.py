"""Detects children that hang: reports the hang, ends the child, and goes down the ladder."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor import child_messages, messages
from executor.child_messages import Place
from executor.session import child_exits, steps
from executor.session.events import Inspect
from executor.session.hangs.vitals import END_AFTER_S, FAULT_AFTER_S, STOPPED
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.questions import answer_late
from executor.session.trace import Frame, action_frame, own_frame
from executor.session.waits import NOT_ANSWERING

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.events import ChildLooked, ChildTraced
    from executor.session.stage import Stage

__all__ = ["looked", "traced"]

LATEST_TRACE_S: Final = FAULT_AFTER_S + 2.0
SPARES_LOST: Final = 2
"""Number of spares lost in a row after which the next spare is started only when it is needed."""
CLOCK_PERIOD_S: Final = 1 / 60
CLOCKS_MISSED: Final = 4
DEAF_AGAIN_S: Final = 60.0
FOUND_AFTER_S: Final = 20.0
TRACE_CHARACTERS: Final = 4000
_TICK_HINT: Final = "update() must return soon: let it return RUNNING while work continues."
_LOAD_HINT: Final = (
    "Code that computes may take long; code that only waits is ended after 8 s. "
    "Wait in update() instead, with RUNNING, for what is not there yet."
)
_FROZEN_HINT: Final = f"It is ended if it does not answer within {END_AFTER_S:g} s; then press Run again."
_SPARE_HINT: Final = f"Another one takes its place if it does not answer within {END_AFTER_S:g} s."
_TIME_HINT: Final = "Press Run: world and application are started again."
_RESTART_HINT: Final = "The application is started again, once."


def looked(stage: Stage, event: ChildLooked, now_s: float) -> None:
    """Evaluates a sample of a child: reports a hang, a recovery, or ends the child."""
    child = stage.children.of(event)
    if event.kind == "recorder":
        stage.recording.looked(event, now_s)
        return
    if event.kind == "trying":
        stage.trying.looked(now_s)
        return
    if event.kind == "source":
        stage.sources.looked(now_s)
        return
    if child is None or event.kind in ("evaluation", "adapter"):  # the first bounds its runs itself
        return
    vitals = child.vitals
    counted_s = vitals.look(event, now_s)
    if child.is_suspended:
        vitals.stuck_s = vitals.idle_s = 0.0  # it is held; other threads still send signs of life
    if child.kind == "world":
        vitals.deaf_s += counted_s
    if vitals.is_lost:
        _end(stage, child)
    elif vitals.hangs and not child.hang:
        _suspect(stage, child)
    elif child.hang and vitals.is_well:
        stage.output.emit(messages.Log("manager", "info", f"{_name(child)} answers again."))
        child.hang, child.was_inspected = "", False
    elif child.kind == "application":
        _listen_for_time(stage, child, counted_s, now_s)
    if not (child.is_started or child.hang or vitals.task):
        stage.children.spares_lost[child.kind] = 0


def traced(stage: Stage, event: ChildTraced) -> None:
    """Reports a hang with the stack dump of the child."""
    child = stage.children.of(event)
    if child is None or child.hang:
        return
    if event.text or not child.vitals.is_well:
        # The hang is reported even if the child has recovered: the signal itself may have ended the wait.
        _tell(stage, child, event)
    else:
        child.was_inspected = False


def _suspect(stage: Stage, child: Child) -> None:
    vitals = child.vitals
    is_dumb = vitals.silent_s >= FAULT_AFTER_S
    if is_dumb and vitals.has_beaten and vitals.state != STOPPED and vitals.silent_s < LATEST_TRACE_S:
        if not child.was_inspected:
            child.was_inspected = True
            stage.output.effect(Inspect(child.kind, child.number))
        return
    _tell(stage, child, None)


def _tell(stage: Stage, child: Child, trace: ChildTraced | None) -> None:
    fault = _fault(stage, child, trace)
    child.hang = fault.message
    stage.output.emit(fault)
    answer_late(
        stage,
        stage.questions.orphaned(child.key),
        NOT_ANSWERING,
        "does not answer",
        fault.message,
    )
    if stage.state in HAS_APPLICATION and child.kind == "application":
        stage.children.tell_world(child_messages.StopRobot())


def _fault(stage: Stage, child: Child, trace: ChildTraced | None) -> messages.Fault:
    vitals = child.vitals
    frozen_hint = _FROZEN_HINT if child.is_in_use else _SPARE_HINT
    # The sentence stays during the hang, so it must not name its length.
    name, for_s = _name(child), f"for more than {FAULT_AFTER_S:g} s"
    if vitals.silent_s < FAULT_AFTER_S and trace is None:
        place = vitals.place
        if vitals.is_in_action:
            text = f"{place.text or 'an action'} has not returned {for_s}"
            return _located(text, _LOAD_HINT if vitals.task else _TICK_HINT, place)
        at = f" (at {place.text})" if place.text else ""
        return _located(f"{name}'s main loop has been stuck {for_s}{at}.", frozen_hint, Place())
    if vitals.state == STOPPED:
        text = f"{name} has not answered {for_s}: its process is stopped."
        return _located(text, frozen_hint, Place())
    text = f"{name} has not answered {for_s}"
    if trace is None or not trace.text:
        return _located(f"{text}: its process is frozen.", frozen_hint, Place())
    place = Place()
    if child.kind == "application" and (frame := action_frame(trace.text)) is not None:
        place = _place_of(stage, frame, trace.uid)
        place.traceback = trace.text[:TRACE_CHARACTERS]
        what = f"{place.node_type} '{place.node_path}'" if place.node_path else "an action"
        text += f": {what} ({frame.file}:{frame.line}) does not let any other Python code run."
        return _located(text, _LOAD_HINT if vitals.task else _TICK_HINT, place)
    place.traceback = trace.text[:TRACE_CHARACTERS]
    own = own_frame(trace.text)
    at = f" at {own.file}:{own.line}" if own is not None else ""
    return _located(f"{text}: it is stuck{at}, and lets no other Python code run.", frozen_hint, place)


def _place_of(stage: Stage, frame: Frame, uid: int) -> Place:
    """Returns the place of a frame, with its node.

    This is the node that is being ticked, or the only one whose action is in the file.
    """
    nodes = stage.mirror.tree.nodes if stage.mirror.tree is not None else []
    kind = frame.file.rsplit("/", 1)[-1].removesuffix(".py")
    same = [node for node in nodes if node.uid == uid] or [node for node in nodes if node.type == kind]
    place = Place(file=frame.file, line=frame.line)
    if len(same) == 1:
        (node,) = same
        place.node_id, place.tree_id = node.node_id, node.tree_id
        place.node_path, place.node_type = node.path, node.type
    return place


def _located(message: str, hint: str, place: Place) -> messages.Fault:
    return messages.Fault(
        "timeout",
        message,
        hint=hint,
        node_id=place.node_id,
        tree_id=place.tree_id,
        node_path=place.node_path,
        file=place.file,
        line=place.line,
        traceback=place.traceback,
    )


def _end(stage: Stage, child: Child) -> None:
    if not child.hang:
        _tell(stage, child, None)
    reason = f"was ended: it did not answer for {END_AFTER_S:g} s"
    if child.is_in_use:
        child_exits.lose(stage, child, reason, f"{_name(child)} {reason}.")
        return
    name = _name(child)
    stage.children.drop(child.kind, reason=reason)
    stage.output.emit(messages.Log("manager", "warning", f"{name} {reason}."))
    stage.children.spares_lost[child.kind] += 1
    if stage.children.spares_lost[child.kind] <= SPARES_LOST and not child.is_started:
        stage.children.ensure(child.kind)


def _name(child: Child) -> str:
    what = "simulated world" if child.kind == "world" else "application"
    return f"The {what}" if child.is_in_use else f"The waiting {what}"


def _listen_for_time(stage: Stage, child: Child, counted_s: float, now_s: float) -> None:
    """Restarts an application that receives no simulated time: it would never tick, and never report that."""
    vitals, world, run = child.vitals, stage.children.get("world"), stage.run
    has_time_apart = not (run.is_outside or child.is_exact)
    is_due = stage.state is State.APPLICATION_RUNNING and has_time_apart and stage.is_free
    if world is None or not is_due or child.hang or world.hang:
        vitals.deaf_s = 0.0
        return
    if vitals.is_well and world.vitals.is_well:
        vitals.deaf_s += counted_s
    speed = stage.mirror.speed
    patience_s = END_AFTER_S if now_s < run.deaf_until_s else FAULT_AFTER_S
    limit_s = max(patience_s, CLOCKS_MISSED * CLOCK_PERIOD_S / speed) if speed > 0 else patience_s
    is_mute = world.vitals.deaf_s > limit_s / 2
    if now_s < run.deaf_until_s and not is_mute:
        # On a busy machine it finds its peers late; a lost world costs more than a wait.
        limit_s = max(limit_s, FOUND_AFTER_S)
    if vitals.deaf_s < limit_s:
        return
    vitals.deaf_s = 0.0
    who = "the simulated world does not publish it" if is_mute else "the application does not receive it"
    text = f"The application runs without simulated time: no /clock for {limit_s:.0f} s, {who}."
    if now_s >= run.deaf_until_s:
        run.deaf_until_s = now_s + DEAF_AGAIN_S
        stage.output.emit(messages.Fault("timeout", text, hint=_RESTART_HINT))
        stage.begin_own("restart_application", steps.restart_application(stage, messages.Empty()))
        return
    stage.output.emit(messages.Fault("timeout", text, hint=_TIME_HINT))
    reason = "was ended: the application had no simulated time, also after it was started again"
    child_exits.lose(stage, world, reason, f"The simulated world {reason}.")
