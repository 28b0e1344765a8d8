"""The session's ladder as data: its states, and the effect of each command in each of them.

The state machine (`executor.session.protocol`), its tests and `docs/reference/protocol.md` all read `TABLE`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

__all__ = ["TABLE", "Row", "State", "is_legal", "where"]


class State(StrEnum):
    """A rung of the ladder.

    States are listed from bottom to top; PAUSED and HELD are as high as APPLICATION_RUNNING.
    """

    IDLE = "idle"
    CONNECTED = "connected"
    UNIVERSE_READY = "universe_ready"
    VISUALIZATION_READY = "visualization_ready"
    APPLICATION_RUNNING = "application_running"
    PAUSED = "paused"
    HELD = "held"

    @property
    def height(self) -> int:
        """The number of rungs below this one."""
        return min(list(State).index(self), 4)

    def reaches(self, other: State) -> bool:
        """Returns whether this rung is at least as high as `other`."""
        return self.height >= other.height


ANY: Final = frozenset(State)
WORLD_UP: Final = frozenset(s for s in State if s.reaches(State.UNIVERSE_READY))
HAS_APPLICATION: Final = frozenset({State.APPLICATION_RUNNING, State.PAUSED, State.HELD})
BETWEEN_TICKS: Final = HAS_APPLICATION - {State.HELD}
RUNNABLE: Final = HAS_APPLICATION | {State.VISUALIZATION_READY}
WORLD_MOVABLE: Final = WORLD_UP - {State.HELD}
WORLD_STANDS: Final = WORLD_MOVABLE - {State.APPLICATION_RUNNING}
HELD: Final = frozenset({State.HELD})


@dataclass(frozen=True)
class Row:
    """One command of the protocol.

    Attributes:
        sources: the states in which the command is legal.
        target: the state after the command; None if the state does not change.
        is_step: whether the command takes time; other steps are refused until it ends, and `cancel` ends it
            early.
        for_viewers: whether viewers may send the command too.
        does: the sentence that describes the command in the reference page.
        idle_in: the states in which the command is legal without an effect.
    """

    sources: frozenset[State]
    target: State | None
    is_step: bool
    for_viewers: bool
    does: str
    idle_in: frozenset[State] = frozenset()


def _move(sources: frozenset[State], target: State, does: str) -> Row:
    return Row(sources, target, is_step=True, for_viewers=False, does=does)


def _move_now(sources: frozenset[State], target: State, does: str) -> Row:
    return Row(sources, target, is_step=False, for_viewers=False, does=does)


def _act(sources: frozenset[State], does: str, *, is_step: bool = False, for_viewers: bool = False) -> Row:
    return Row(sources, None, is_step, for_viewers, does)


TABLE: Final[dict[str, Row]] = {
    "connect": _move(frozenset({State.IDLE}), State.CONNECTED, "Begins the session."),
    "launch_universe": _move(
        frozenset({State.CONNECTED}), State.UNIVERSE_READY, "Starts world and robots, paused."
    ),
    "prepare_visualization": _move(
        frozenset({State.UNIVERSE_READY}), State.VISUALIZATION_READY, "Opens the streams."
    ),
    "run_application": _move(
        RUNNABLE, State.APPLICATION_RUNNING, "(Re)starts the application and un-pauses the world."
    ),
    "run": _move(
        ANY,
        State.APPLICATION_RUNNING,
        "Climbs all missing rungs; a running world is reset, or replaced for another universe.",
    ),
    "restart_application": _move(
        RUNNABLE, State.APPLICATION_RUNNING, "Restarts the application of the last run."
    ),
    "apply": _act(
        BETWEEN_TICKS, "Replaces the running tree by a changed one, which continues.", is_step=True
    ),
    "pause": Row(
        frozenset({State.APPLICATION_RUNNING, State.HELD}),
        State.PAUSED,
        is_step=True,
        for_viewers=False,
        does="Stops ticks and simulated time together.",
        idle_in=HELD,
    ),
    "resume": _move(
        frozenset({State.PAUSED}), State.APPLICATION_RUNNING, "Resumes ticks and simulated time."
    ),
    "go_back": _move(
        RUNNABLE, State.PAUSED, "Takes world and program of an exact run back to a moment, and pauses there."
    ),
    "tick_back": _move(
        frozenset({State.PAUSED, State.HELD}),
        State.PAUSED,
        "Takes an exact run back to the begin of the last whole tick, and pauses there.",
    ),
    "run_on": _move(
        frozenset({State.PAUSED}), State.APPLICATION_RUNNING, "Resumes with a changed tree, which continues."
    ),
    "terminate_application": _move(
        RUNNABLE,
        State.VISUALIZATION_READY,
        "Ends the application, sends a zero `/cmd_vel` and pauses the world.",
    ),
    "terminate_visualization": _move(
        frozenset({State.VISUALIZATION_READY}), State.UNIVERSE_READY, "Closes the streams."
    ),
    "terminate_universe": _move(frozenset({State.UNIVERSE_READY}), State.CONNECTED, "Ends the world."),
    "disconnect": _move(ANY, State.IDLE, "Ends everything, in order."),
    "cancel": _act(ANY, "Ends the step under way; the ladder stays on the last rung reached."),
    "step": _act(frozenset({State.PAUSED}), "One tick, and `1/tick_hz` of simulated time.", is_step=True),
    "set_tick_rate": _act(BETWEEN_TICKS, "Changes the tick rate from the next tick on."),
    "set_port": _act(BETWEEN_TICKS, "Changes a port of a running node from the next tick on."),
    "set_speed": _act(WORLD_MOVABLE, "Changes how fast simulated time passes."),
    "reset_world": _act(WORLD_MOVABLE, "Restores the initial state of the world."),
    "run_world": _act(
        frozenset({State.VISUALIZATION_READY}),
        "Lets the world run without an application, until it is stopped or an application starts.",
    ),
    "set_blackboard": _act(
        frozenset({State.PAUSED, State.HELD}), "Writes an entry of the blackboard.", is_step=True
    ),
    "set_breakpoints": _act(ANY, "Replaces the breakpoints, also those of later runs."),
    "continue_run": _move_now(HELD, State.APPLICATION_RUNNING, "Lets a held tree run on."),
    "step_into": _act(HELD, "Continues to the next event at any node."),
    "step_over": _act(HELD, "Continues until the node is done."),
    "step_out": _act(HELD, "Continues until the parent of the node is done."),
    "step_to": _act(HELD, "Continues until a node is to be ticked."),
    "force": _act(HAS_APPLICATION, "Forces a result on a node, freezes it, skips to it, or ticks it alone."),
    "release": _act(HAS_APPLICATION, "Ends what is forced on a node, or on all."),
    "control": _act(ANY, "Sets whether the user controls the robot of an attached session."),
    "profile": _act(ANY, "Measures the time of each node, also in later runs, or no longer."),
    "serve_groot2": _act(ANY, "Lets Groot2 look at the tree, also in later runs, or no longer."),
    "dap": _act(ANY, "Debugs Python: a request for debugpy's adapter; answers and events are `dap` events."),
    "teleop": _act(WORLD_MOVABLE, "Drives the robot by hand."),
    "move_body": _act(WORLD_STANDS, "Sets the pose of a body."),
    "subscribe": _act(ANY, "Subscribes to a stream, or changes the subscription.", for_viewers=True),
    "unsubscribe": _act(ANY, "Ends a stream.", for_viewers=True),
    "list_topics": _act(WORLD_UP, "Answers with a `topics` event.", for_viewers=True),
    "echo_topic": _act(WORLD_UP, "Sends the messages of a topic.", for_viewers=True),
    "publish_topic": _act(
        WORLD_MOVABLE, "Publishes one message; refused (`world_paused`) while time is paused."
    ),
    "describe_type": _act(WORLD_UP, "Answers with a `type_description` event.", for_viewers=True),
    "restart_node": _act(BETWEEN_TICKS, "Restarts a node of the launch files."),
    "read_recording": _act(
        ANY, "Reads a part of a recording; it comes as a frame `recording`.", for_viewers=True
    ),
    "flag": _act(
        WORLD_UP,
        "Sets, changes or removes a mark of the user at a moment of the present run.",
    ),
    "branches": _act(ANY, "Answers with a `branch` event for each branch of the session.", for_viewers=True),
    "name_branch": _act(ANY, "Gives a branch a name."),
    "drop_branch": _act(ANY, "Throws a branch away, with its recording."),
    "evaluate": _act(
        ANY, "Runs seeds of an evaluation beside the ladder; answers with `evaluation_` events."
    ),
    "try_values": _act(
        ANY,
        "Continues a run from a moment under several values of a port, beside the ladder; answers with "
        "`trying_` events.",
    ),
    "try_seeds": _act(
        ANY,
        "Continues a run from a moment under several seeds, beside the ladder; answers with "
        "`trying_` events.",
    ),
    "stop_trying": _act(ANY, "Ends these continuations."),
    "source_of_tick": _act(
        ANY,
        "Makes an exact run again up to a past tick, beside the ladder, and answers with `tick_source`: the "
        "lines that it ran, and the values of names.",
    ),
    "stop_source": _act(ANY, "Ends that."),
    "take_over": _act(ANY, "Becomes the driver; the last driver becomes a viewer.", for_viewers=True),
    "ping": _act(
        ANY, "Is answered at once; no answer for 3 s means that the manager hangs.", for_viewers=True
    ),
}


def is_legal(state: State, command: str) -> bool:
    """Returns whether the command may be sent in this state."""
    return state in TABLE[command].sources


def where(command: str) -> str:
    """Returns the names of the states in which a command is legal."""
    return ", ".join(state for state in State if state in TABLE[command].sources)
