"""Holds of the debugger: the tree is stopped within a tick, and so is the world.

The application says when its tree is held and when it runs on; between the steps of one tick it stays held.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from msgspec.structs import replace

from executor import child_messages, messages
from executor.child_messages import event_of
from executor.session.ladder import HAS_APPLICATION, State

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.stage import Stage

__all__ = [
    "HOLD_DRIVER_GRACE_S",
    "Hold",
    "deadline_s",
    "expire",
    "give_breakpoints",
    "held",
    "released",
    "settle",
]

HOLD_DRIVER_GRACE_S: Final = 60.0
OFF: Final = messages.SetBreakpoints([], on=False)
OUTSIDE_TEXT: Final = (
    "The tree is held, but the robot is not: it belongs to an outside ROS graph and keeps moving. The topics "
    "on which this run has sent velocities get zero ten times a second."
)


@dataclass
class Hold:
    """The debugger of a session: its breakpoints, its profile, and since when the tree is held.

    Attributes:
        breakpoints: for the runs to come, too; None before the first command.
        profile: whether nodes are measured, also in the runs to come.
        groot2: the port at which Groot2 may look at the tree, also in the runs to come; 0 for none.
        since_s: when the tree was held first, without a command of the driver since then; None if it is not.
    """

    breakpoints: messages.SetBreakpoints | None = None
    profile: messages.SetProfile | None = None
    groot2: int = 0
    since_s: float | None = None
    given: messages.SetBreakpoints | None = None
    """The breakpoints that the application has."""
    given_late: messages.SetBreakpoints | None = None
    """Those that it has not answered in time: they are kept as if it had taken them."""
    profile_given: messages.SetProfile | None = None
    """The profile with which it was started."""
    groot2_given: int = 0
    """The port for Groot2 with which it was started."""

    def switch_off(self) -> None:
        """Switches all breakpoints off, until a client sets them again."""
        if self.breakpoints is not None:
            self.breakpoints = self.given = replace(self.breakpoints, on=False)


def held(stage: Stage, child: Child, message: child_messages.Held) -> None:
    """Handles the message that the tree is held: the world is paused, too."""
    child.is_holding = True
    if child.is_stopping:
        return
    stage.children.tell_world(child_messages.Pause())
    if stage.run.is_outside and stage.attaching is None and stage.hold.since_s is None:
        stage.output.emit(messages.Log("manager", "warning", OUTSIDE_TEXT, time=stage.sim_time_s))
    if stage.hold.since_s is None:
        stage.hold.since_s = stage.now_s
    event = event_of(message, messages.Held)
    event.outside = stage.run.is_outside
    stage.output.emit(event)
    if stage.state in HAS_APPLICATION and stage.state is not State.HELD:
        stage.enter(State.HELD)


def released(stage: Stage, child: Child, message: child_messages.Released) -> None:
    """Handles the message that the tree runs on."""
    child.is_holding = False
    stage.hold.since_s = None
    wanted = stage.hold.breakpoints
    stage.output.emit(messages.Released(off=wanted is not None and not wanted.on))
    if child.is_stopping or stage.state is not State.HELD:
        return
    if message.paused:
        stage.enter(State.PAUSED)
        return
    stage.children.tell_world(child_messages.Resume())
    stage.enter(State.APPLICATION_RUNNING)


def give_breakpoints(stage: Stage) -> None:
    """Gives the application the breakpoints that were set while it was loading."""
    hold = stage.hold
    if hold.breakpoints is not None and hold.breakpoints is not hold.given:
        hold.given = hold.breakpoints
        stage.children.tell_application(child_messages.SetBreakpoints(wanted=hold.breakpoints))


def settle(stage: Stage, application: Child) -> None:
    """Enters the state of a run that has begun or continues: the tree may be held already."""
    hold = stage.hold
    give_breakpoints(stage)
    if hold.profile is not None and hold.profile is not hold.profile_given:
        hold.profile_given = hold.profile  # it was switched while the application was loading
        stage.children.tell_application(child_messages.MeasureNodes(wanted=hold.profile))
    if hold.groot2 != hold.groot2_given:
        hold.groot2_given = hold.groot2  # as above
        stage.children.tell_application(child_messages.ServeGroot2(port=hold.groot2))
    is_held = application.is_holding or stage.python.is_stopped
    if is_held:
        stage.children.tell_world(child_messages.Pause())
    stage.enter(State.HELD if is_held else State.APPLICATION_RUNNING)


def deadline_s(stage: Stage) -> float | None:
    """Returns the time at which a hold ends by itself; None if it does not."""
    since_s, limit_s = stage.hold.since_s, stage.about.hold_limit_s
    if stage.state is not State.HELD or since_s is None:
        return None
    left_s = stage.clients.driver_left_s
    times = [since_s + limit_s] if limit_s else []
    times += [max(left_s, since_s) + HOLD_DRIVER_GRACE_S] if left_s is not None else []
    return min(times, default=None)


def expire(stage: Stage) -> None:
    """Ends a hold that has lasted too long, or whose driver has been away for too long."""
    until_s = deadline_s(stage)
    if until_s is None or stage.now_s < until_s:
        return
    is_away = stage.clients.driver_left_s is not None
    limit_s = stage.about.hold_limit_s
    stage.hold.since_s = None
    stage.hold.switch_off()
    if stage.python.is_stopped:
        stage.python.pauses = is_away
        stage.children.tell_application(child_messages.SetBreakpoints(wanted=OFF))
        if is_away:
            stage.children.tell_application(child_messages.Pause())
        stage.python.end()
    if (application := stage.children.get("application")) is not None and application.is_holding:
        stage.children.tell_application(child_messages.Continue(off=True, pauses=is_away))
    text = (
        f"The driver was away for {HOLD_DRIVER_GRACE_S:g} s while the tree was held: "
        "all breakpoints are off, and the run is paused."
        if is_away
        else f"The tree was held for {limit_s / 60.0:g} min: all breakpoints are off, and the run continues."
    )
    stage.output.emit(messages.Log("manager", "warning", text, time=stage.sim_time_s))
