"""Exact runs: the application has the world in it, and gives it back at its end.

The process of the world keeps the world while no application runs. An exact run begins with its state, and
all commands for the world go to the run meanwhile; at the end the state comes back.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor import child_messages, messages
from executor.child_messages import WorldState
from executor.session import streaming
from executor.session.waits import Answered, StepFailed, confirmed

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.stage import Stage

__all__ = ["choose", "expect", "give_back", "host", "state_of_world"]

STATE_TIMEOUT_S: Final = 20.0
_AS_BEFORE: Final = "The run left no world: it is as it was when the run began."
_OUTSIDE: Final = "it joins an outside ROS graph, whose time does not wait"
_LAUNCH_FILES: Final = "its launch files start nodes of their own, and their time does not wait"


def choose(stage: Stage) -> None:
    """Chooses the kind of the next run, and says why it is live where an exact one is wanted."""
    run = stage.run
    reason = _OUTSIDE if run.is_outside else _LAUNCH_FILES if run.plan.nodes else ""
    if run.wants_exact and reason:
        stage.output.emit(messages.Log("manager", "warning", f"This run is live: {reason}."))
    stage.children.wants_exact = run.wants_exact and not reason


def expect(stage: Stage, launch: messages.LaunchUniverse) -> None:
    """Starts the spare for the kind of run that a launch wants, before its launch files are known."""
    stage.children.wants_exact = launch.time == "exact" and launch.universe != "none"
    stage.children.replenish()


def state_of_world(stage: Stage) -> Answered[WorldState]:
    """Pauses the world and returns its state."""
    world = stage.children.ensure("world")
    stage.children.tell_world(child_messages.Pause())
    stage.run.is_world_alone = False
    world.forget(WorldState)
    order = stage.children.order("world", child_messages.DumpWorld())
    yield confirmed(order, "give its state", STATE_TIMEOUT_S)
    state = world.said(WorldState)
    if state is None:
        raise StepFailed("no_state", "The simulated world did not give its state.", "Press Run again.")
    return state


def host(stage: Stage, application: Child) -> None:
    """Gives the streams and all commands for the world to an exact run."""
    if not application.is_exact:
        return
    streaming.close_all(stage)
    for topic in stage.clients.echoes():
        stage.children.tell_world(child_messages.EchoTopic(topic, 0.0))
    stage.children.host = application
    stage.snapshots.begin(application)
    streaming.open_all(stage)
    streaming.resume_echoes(stage)


def give_back(stage: Stage, child: Child, state: bytes = b"") -> None:
    """Gives the world back to its own process, with its state if the run left one."""
    if stage.children.host is not child:
        return
    stage.children.host = None
    if state:
        stage.children.tell_world(child_messages.LoadWorld(data=state))
    else:
        stage.output.emit(messages.Log("manager", "info", _AS_BEFORE))
    stage.children.tell_world(child_messages.SetSpeed(stage.mirror.speed))
    streaming.open_all(stage)
    streaming.resume_echoes(stage)
