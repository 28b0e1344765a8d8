"""What the session does about a child that hangs: say so, end it, and go down to what is still true."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor import messages
from executor.session import child_exits, steps
from executor.session.events import Inspect
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.trace import Frame, action_frame, own_frame
from executor.session.vitals import END_AFTER_S, FAULT_AFTER_S, STOPPED
from executor.session.waits import NOT_ANSWERING

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.events import ChildLooked, ChildTraced
    from executor.session.protocol import Session

__all__ = ["looked", "traced"]

LATEST_TRACE_S: Final = FAULT_AFTER_S + 2.0
SPARES_LOST: Final = 2
"""In a row: then the next one is started only when it is needed."""
CLOCK_PERIOD_S: Final = 1 / 60
CLOCKS_MISSED: Final = 4
DEAF_AGAIN_S: Final = 60.0
TRACE_CHARACTERS: Final = 4000
_TICK_HINT: Final = "update() must return soon: let it return RUNNING while work goes on."
_LOAD_HINT: Final = (
    "What computes may take its time; what only waits is ended after 8 s. "
    "Wait in update() instead, with RUNNING, for what is not there yet."
)
_FROZEN_HINT: Final = f"It is ended if it does not answer within {END_AFTER_S:g} s; then press Run again."
_SPARE_HINT: Final = f"Another one takes its place if it does not answer within {END_AFTER_S:g} s."
_TIME_HINT: Final = "Press Run: world and application are started again."
_RESTART_HINT: Final = "The application is started again, once."


def looked(session: Session, event: ChildLooked, now_s: float) -> None:
    """Judges a child each time that it was looked at."""
    child = session.children.get(event.kind)
    if child is None or child.number != event.number:
        return
    vitals = child.vitals
    counted_s = vitals.look(event, now_s)
    if child.kind == "world":
        vitals.deaf_s += counted_s
    if vitals.is_lost:
        _end(session, child)
    elif vitals.hangs and not child.hang:
        _suspect(session, child)
    elif child.hang and vitals.is_well:
        session.emit(messages.Log("manager", "info", f"{_name(child)} answers again."))
        child.hang, child.was_inspected = "", False
    elif child.kind == "application":
        _listen_for_time(session, child, counted_s, now_s)
    if not (child.is_started or child.hang or vitals.task):
        session.spares_lost[child.kind] = 0


def traced(session: Session, event: ChildTraced) -> None:
    """A child that is silent has been asked where it is."""
    child = session.children.get(event.kind)
    if child is None or child.number != event.number or child.hang:
        return
    if event.text or not child.vitals.is_well:
        _tell(session, child, event)  # the signal may have ended the very wait that it asks about
    else:
        child.was_inspected = False


def _suspect(session: Session, child: Child) -> None:
    vitals = child.vitals
    is_dumb = vitals.silent_s >= FAULT_AFTER_S
    if is_dumb and vitals.has_beaten and vitals.state != STOPPED and vitals.silent_s < LATEST_TRACE_S:
        if not child.was_inspected:
            child.was_inspected = True
            session.effect(Inspect(child.kind, child.number))
        return
    _tell(session, child, None)


def _tell(session: Session, child: Child, trace: ChildTraced | None) -> None:
    fault = _fault(session, child, trace)
    child.hang = fault.message
    session.emit(fault)
    session.answer_late(
        session.questions.orphaned((child.kind, child.number)),
        NOT_ANSWERING,
        "does not answer",
        fault.message,
    )
    if session.state in HAS_APPLICATION and child.kind == "application":
        session.tell("world", "stop_robot")


def _fault(session: Session, child: Child, trace: ChildTraced | None) -> messages.Fault:
    vitals = child.vitals
    frozen_hint = _FROZEN_HINT if child.is_in_use else _SPARE_HINT
    name, for_s = _name(child), f"for {FAULT_AFTER_S:g} s"
    if vitals.silent_s < FAULT_AFTER_S and trace is None:
        place = vitals.place
        if vitals.is_in_action:
            text = f"{place.get('text', 'an action')} has not returned {for_s}"
            return _located(text, _LOAD_HINT if vitals.task else _TICK_HINT, place)
        at = f" (at {place['text']})" if place.get("text") else ""
        return _located(f"{name} has not come round {for_s}{at}.", frozen_hint, {})
    if vitals.state == STOPPED:
        text = f"{name} has not answered {for_s}: its process is stopped, as by SIGSTOP."
        return _located(text, frozen_hint, {})
    text = f"{name} has not answered {for_s}"
    if trace is None or not trace.text:
        return _located(f"{text}: its process is frozen.", frozen_hint, {})
    place = {"traceback": trace.text[:TRACE_CHARACTERS]}
    if child.kind == "application" and (frame := action_frame(trace.text)) is not None:
        place |= _place_of(session, frame, trace.uid)
        what = f"{place['node_type']} '{place['node_path']}'" if place.get("node_path") else "an action"
        text += f": {what} ({frame.file}:{frame.line}) does not let any other Python code run."
        return _located(text, _LOAD_HINT if vitals.task else _TICK_HINT, place)
    own = own_frame(trace.text)
    at = f" at {own.file}:{own.line}" if own is not None else ""
    return _located(f"{text}: it is stuck{at}, and lets no other Python code run.", frozen_hint, place)


def _place_of(session: Session, frame: Frame, uid: int) -> dict[str, Any]:
    """The node that is ticked, or the only one whose action the file is."""
    nodes = session.mirror.tree.nodes if session.mirror.tree is not None else []
    kind = frame.file.rsplit("/", 1)[-1].removesuffix(".py")
    same = [node for node in nodes if node.uid == uid] or [node for node in nodes if node.type == kind]
    place: dict[str, Any] = {"file": frame.file, "line": frame.line}
    if len(same) != 1:
        return place
    (node,) = same
    more = {"node_id": node.node_id, "tree_id": node.tree_id, "node_path": node.path, "node_type": node.type}
    return place | more


def _located(message: str, hint: str, place: dict[str, Any]) -> messages.Fault:
    return messages.Fault(
        "timeout",
        message,
        hint=hint,
        node_id=str(place.get("node_id", "")),
        tree_id=str(place.get("tree_id", "")),
        node_path=str(place.get("node_path", "")),
        file=str(place.get("file", "")),
        line=int(place.get("line", 0)),
        traceback=str(place.get("traceback", "")),
    )


def _end(session: Session, child: Child) -> None:
    if not child.hang:
        _tell(session, child, None)
    reason = f"was ended: it did not answer for {END_AFTER_S:g} s"
    if child.is_in_use:
        child_exits.lose(session, child, reason, f"{_name(child)} {reason}.")
        return
    name = _name(child)
    session.drop(child.kind, reason=reason)
    session.emit(messages.Log("manager", "warning", f"{name} {reason}."))
    session.spares_lost[child.kind] += 1
    if session.spares_lost[child.kind] <= SPARES_LOST and not child.is_started:
        session.child(child.kind)


def _name(child: Child) -> str:
    what = "simulated world" if child.kind == "world" else "application"
    return f"The {what}" if child.is_in_use else f"The waiting {what}"


def _listen_for_time(session: Session, child: Child, counted_s: float, now_s: float) -> None:
    """An application that hears no simulated time would never tick, and never say so."""
    vitals, world, run = child.vitals, session.children.get("world"), session.run
    is_due = session.state is State.APPLICATION_RUNNING and not run.is_outside and session.is_free
    if world is None or not is_due or child.hang or world.hang:
        vitals.deaf_s = 0.0
        return
    if vitals.is_well and world.vitals.is_well:
        vitals.deaf_s += counted_s
    speed = session.mirror.speed
    limit_s = max(FAULT_AFTER_S, CLOCKS_MISSED * CLOCK_PERIOD_S / speed) if speed > 0 else FAULT_AFTER_S
    if vitals.deaf_s < limit_s:
        return
    vitals.deaf_s = 0.0
    who = (
        "the simulated world publishes none" if world.vitals.deaf_s > limit_s / 2 else "it does not hear any"
    )
    text = f"The application runs without simulated time: no /clock for {limit_s:.0f} s, {who}."
    if now_s >= run.deaf_until_s:
        run.deaf_until_s = now_s + DEAF_AGAIN_S
        session.emit(messages.Fault("timeout", text, hint=_RESTART_HINT))
        session.begin_own("restart_application", steps.restart_application(session, messages.Empty()))
        return
    session.emit(messages.Fault("timeout", text, hint=_TIME_HINT))
    reason = "was ended: the application had no simulated time, also after it was started again"
    child_exits.lose(session, world, reason, f"The simulated world {reason}.")
