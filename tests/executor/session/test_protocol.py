"""The session's state machine: every command in every state, and sessions as plays."""

from __future__ import annotations

import pytest

from executor.child_messages import Beat, Log, Place, StepWorld, Tick
from executor.messages import COMMANDS
from executor.session.events import (
    ChildExited,
    ChildSaid,
    ClientJoined,
    Interrupt,
    Kill,
    Retire,
    Spawn,
    Tell,
    Unpack,
    Unpacked,
)
from executor.session.immediate import IMMEDIATE
from executor.session.ladder import HAS_APPLICATION, TABLE, State, is_legal
from executor.session.protocol import Session
from executor.session.stage import About
from executor.session.steps import STEPS
from tests.executor.session.play import DATA, Play

REFUSED = {
    "read_recording": "no_stream",
    "flag": "not_recorded",
    "control": "not_attached",
    "name_branch": "unknown_branch",
    "drop_branch": "unknown_branch",
    "go_back": "no_run",
}
"""What a session answers that is neither recorded nor attached."""
PAIRS = [(state, command) for state in State for command in TABLE]


def test_the_table_knows_every_command_and_each_is_done_somewhere():
    assert set(TABLE) == set(COMMANDS)
    assert set(STEPS) == {name for name, row in TABLE.items() if row.is_step}
    assert set(IMMEDIATE) == set(TABLE) - set(STEPS) - {"cancel"}


@pytest.mark.parametrize(("state", "command"), PAIRS)
def test_every_command_in_every_state(state, command):
    play = Play()
    play.climb(state)
    before = play.state
    request = play.command(command)
    if not is_legal(state, command):
        assert play.reply(request) == "wrong_state"
        assert play.state is before
    elif command == "restart_application" and state is State.VISUALIZATION_READY:
        assert play.reply(request) == "nothing_to_restart"
        assert play.state is before
    elif command == "publish_topic" and state is not State.APPLICATION_RUNNING:
        assert play.reply(request) == "world_paused"
        assert play.state is before
    elif command == "restart_node":
        assert play.reply(request) == "unknown_node"
        assert play.state is before
    elif command in ("try_values", "try_seeds", "source_of_tick"):
        assert play.reply(request) == ("live_run" if state in HAS_APPLICATION else "no_run")
        assert play.state is before
    elif command == "tick_back":
        assert play.reply(request) == "live_run"
        assert play.state is before
    elif command == "go_back" and state in HAS_APPLICATION:
        assert play.reply(request) == "not_recorded"
        assert play.state is before
    elif command in REFUSED:
        assert play.reply(request) == REFUSED[command]
        assert play.state is before
    else:
        assert play.reply(request) == "ack"
        row = TABLE[command]
        assert play.state is ((None if state in row.idle_in else row.target) or before)


@pytest.mark.parametrize(("state", "command"), PAIRS)
def test_a_viewer_may_look_only(state, command):
    play = Play()
    play.climb(state)
    play.happens(ClientJoined("v"))
    request = play.command(command, client="v")
    if not TABLE[command].for_viewers:
        assert play.reply(request) == "not_driver"
    else:
        done = REFUSED.get(command, "ack")
        assert play.reply(request) == (done if is_legal(state, command) else "wrong_state")
    assert play.state is state


@pytest.mark.parametrize(("state", "kind"), [(s, k) for s in State for k in ("world", "application")])
def test_every_state_when_a_child_dies(state, kind):
    play = Play()
    play.climb(state)
    if kind not in play.session.children.living:
        assert state is State.IDLE
        return
    play.child_dies(kind, "was killed by SIGKILL", "last words")
    if kind == "world" and state.reaches(State.UNIVERSE_READY):
        expected = State.CONNECTED
    elif kind == "application" and state in HAS_APPLICATION:
        expected = State.VISUALIZATION_READY
    else:
        expected = state
    assert play.state is expected
    if expected is not state:
        (fault,) = play.sent("fault")
        assert fault.kind == "process"
        assert "SIGKILL" in fault.message
        assert "last words" in fault.traceback
        assert play.sent("state-changed")[-1].reason == fault.message
        assert play.reply(play.command("run")) == "ack"
        assert play.state is State.APPLICATION_RUNNING


def test_a_state_change_comes_before_its_ack():
    play = Play()
    request = play.command("connect")
    names = [e.name for e in play.effects if hasattr(e, "name")]
    assert names.index("state-changed") < names.index("ack")
    assert play.reply(request) == "ack"


def test_run_climbs_every_rung_and_starts_both_processes_at_once():
    play = Play()
    play.command("run")
    assert [e.state for e in play.sent("state-changed")] == [
        "connected",
        "universe_ready",
        "visualization_ready",
        "application_running",
    ]
    assert play.did(Spawn) == ["world", "application"]
    assert play.told("world") == ["start", "resume"]
    assert play.told("application") == ["start", "resume"]
    assert {e.rung for e in play.sent("progress")} == {
        "launch_universe",
        "prepare_visualization",
        "run_application",
    }


def test_the_application_loads_while_the_world_starts():
    play = Play(obedient=False)
    play.command("run")
    (unpack,) = (e for e in play.effects if isinstance(e, Unpack))
    play.happens(Unpacked(unpack.token, "/app"))
    assert play.told("application") == ["start"]
    assert play.told("world") == ["start"]
    play.child_says("application", "ready")
    assert play.state is State.CONNECTED
    play.obedient = True
    play.child_says("world", "ready", renderer="egl", tf=False, universe="Room")
    assert play.state is State.APPLICATION_RUNNING


def test_a_second_run_keeps_the_world_and_resets_it():
    play = Play()
    play.command("run")
    play.effects.clear()
    assert play.reply(play.command("run")) == "ack"
    assert play.told("world") == ["stop_robot", "pause", "reset", "set_speed", "resume"]
    assert play.told("application") == ["stop", "start", "resume"]
    assert [e.state for e in play.sent("state-changed")] == ["visualization_ready", "application_running"]


def test_a_run_in_another_universe_replaces_the_world():
    play = Play()
    play.command("run")
    play.effects.clear()
    other = DATA["run"] | {"universe": {"universe": "maze"}}
    assert play.reply(play.command("run", **other)) == "ack"
    assert play.did(Retire) == ["world"]
    assert play.told("world")[-2:] == ["start", "resume"]
    assert play.session.mirror.snapshot().universe == "Walled room"


def test_other_commands_are_answered_during_a_long_step():
    play = Play(obedient=False)
    run = play.command("run")
    assert play.reply(play.command("subscribe")) == "ack"
    assert play.reply(play.command("pause")) == "busy"
    assert play.reply(run) is None
    cancel = play.command("cancel")
    assert (play.reply(run), play.reply(cancel)) == ("cancelled", "ack")
    assert play.state is State.CONNECTED


def test_cancelling_a_launch_ends_its_world_and_a_new_one_stands_by():
    play = Play(obedient=False)
    play.command("connect")
    launch = play.command("launch_universe")
    first = play.session.children.living["world"].number
    play.command("cancel")
    assert play.reply(launch) == "cancelled"
    assert play.did(Kill) == ["world"]
    assert play.session.children.living["world"].number > first


def test_cancel_without_a_step_is_harmless():
    play = Play()
    assert play.reply(play.command("cancel")) == "ack"


def test_a_world_that_is_never_ready_fails_in_bounded_time():
    play = Play(obedient=False)
    play.command("connect")
    launch = play.command("launch_universe")
    play.later(59)
    assert play.reply(launch) is None
    play.later(1)
    assert play.reply(launch) == "timeout"
    assert play.state is State.CONNECTED


def test_a_world_that_refuses_its_universe_reports_why():
    play = Play(obedient=False)
    play.command("connect")
    launch = play.command("launch_universe")
    play.child_says("world", "error", code="unknown_universe", message="There is no 'mars'.", hint="maze")
    assert play.reply(launch) == "unknown_universe"
    assert play.reply(play.command("launch_universe")) is None


def test_an_application_that_does_not_load_leaves_the_world_up():
    play = Play(obedient=False)
    play.obedient = True
    play.climb(State.VISUALIZATION_READY)
    play.obedient = False
    run = play.command("run_application")
    play.happens(Unpacked(play.session._archives, "/app"))
    play.child_says("application", "fault", kind="load", message="bad syntax", file="actions/A.py", line=3)
    assert play.reply(run) == "load_failed"
    assert play.sent("fault")[-1].file == "actions/A.py"
    assert play.state is State.VISUALIZATION_READY
    play.obedient = True
    assert play.reply(play.command("run")) == "ack"


def test_a_bad_archive_is_refused():
    play = Play(obedient=False)
    run = play.command("run")
    play.happens(Unpacked(1, error="not a zip"))
    assert play.reply(run) == "bad_archive"


def test_the_application_finishes_by_itself():
    play = Play()
    play.command("run")
    play.effects.clear()
    play.child_says("application", "finished", status="SUCCESS", reason="root_finished", message="Done.")
    assert play.state is State.VISUALIZATION_READY
    assert play.sent("finished")[0].status == "SUCCESS"
    assert play.told("world") == ["stop_robot", "pause"]
    assert play.sent("state-changed")[-1].reason == "Done."
    assert play.did(Spawn) == ["application"]


def test_stop_ends_the_application_and_leaves_the_world():
    play = Play()
    play.command("run")
    play.effects.clear()
    assert play.reply(play.command("terminate_application")) == "ack"
    assert play.state is State.VISUALIZATION_READY
    assert play.sent("finished")[0].reason == "terminated"
    assert play.sent("fault") == []
    assert play.reply(play.command("terminate_application")) == "ack"


def hang(command):
    """Returns a play whose application does not answer any more, and the request."""
    play = Play()
    play.climb(State.PAUSED if command == "step" else State.APPLICATION_RUNNING)
    play.effects.clear()
    play.obedient = False
    request = play.command(command)
    play.later(0.5)
    assert play.did(Interrupt) == []
    play.later(5)
    assert play.did(Interrupt) == ["application"]
    return play, request


@pytest.mark.parametrize("command", ["pause", "step", "terminate_application", "run"])
def test_a_hanging_tick_is_interrupted_and_named(command):
    play, request = hang(command)
    play.child_says("application", "fault", kind="timeout", message="hangs", file="actions/A.py", line=5)
    play.child_says("application", "finished", status="FAILURE", reason="action_raised")
    assert play.state in {State.VISUALIZATION_READY, State.APPLICATION_RUNNING}
    assert len(play.sent("fault")) == 1
    assert len(play.sent("finished")) == 1
    expected = {"pause": "tick_hangs", "step": "tick_hangs", "terminate_application": "ack", "run": None}
    assert play.reply(request) == expected[command]


@pytest.mark.parametrize("command", ["pause", "step", "terminate_application"])
def test_a_tick_that_cannot_be_interrupted_is_killed(command):
    play, request = hang(command)
    number = play.session.children.living["application"].number
    play.happens(
        ChildSaid(
            "application",
            number,
            Beat(turns=9, place=Place(node_path="main/Stuck", text="Act 'main/Stuck'")),
        )
    )
    play.later(1)
    assert play.did(Kill) == ["application"]
    assert play.state is State.VISUALIZATION_READY
    assert play.sent("fault")[0].node_path == "main/Stuck"
    assert play.reply(request) in {"tick_hangs", "ack"}
    play.obedient = True
    assert play.reply(play.command("run")) == "ack"


def test_the_application_dies_while_it_is_paused_by_us():
    play = Play()
    play.command("run")
    play.obedient = False
    request = play.command("pause")
    play.child_dies("application")
    assert play.reply(request) == "process_died"
    assert play.state is State.VISUALIZATION_READY


def test_the_world_dies_while_the_application_loads():
    play = Play(obedient=False)
    run = play.command("run")
    play.happens(Unpacked(1, "/app"))
    play.child_says("world", "ready")
    play.child_dies("world")
    assert play.reply(run) == "process_died"
    assert play.state is State.CONNECTED
    play.obedient = True
    assert play.reply(play.command("run")) == "ack"


def test_a_slow_tick_stops_the_robot_and_continues():
    play = Play()
    play.command("run")
    play.effects.clear()
    play.child_says("application", "fault", kind="timeout", message="long", node_id="n4")
    assert play.state is State.APPLICATION_RUNNING
    assert play.told("world") == ["stop_robot"]


def test_a_step_is_one_tick_and_one_period():
    play = Play()
    play.climb(State.PAUSED)
    play.effects.clear()
    play.command("step")
    (world_step,) = (e for e in play.effects if isinstance(e, Tell) and e.kind == "world")
    assert isinstance(world_step.message, StepWorld)
    assert world_step.message.dt_s == 0.05


@pytest.mark.parametrize("state", list(State))
def test_disconnect_ends_everything_and_may_be_repeated(state):
    play = Play()
    play.climb(state)
    assert play.reply(play.command("disconnect")) == "ack"
    assert play.state is State.IDLE
    assert play.session.children.living == {}
    assert play.session.children.leaving == set()
    assert play.reply(play.command("disconnect")) == "ack"
    assert play.reply(play.command("run")) == "ack"


def test_disconnect_interrupts_a_long_step_and_waits_for_the_processes():
    play = Play(obedient=False)
    run = play.command("run")
    first, second = play.command("disconnect"), play.command("disconnect")
    assert play.reply(run) == "cancelled"
    assert play.reply(first) is None
    for kind, number in list(play.session.children.leaving):
        play.happens(ChildExited(kind, number, "was killed"))
    assert (play.reply(first), play.reply(second)) == ("ack", "ack")
    assert play.state is State.IDLE


def test_of_a_dropped_child_only_log_lines_are_forwarded():
    play = Play()
    play.command("run")
    old = play.session.children.living["application"].number
    play.command("run")
    play.effects.clear()
    play.happens(ChildSaid("application", old, Tick(n=9, changed=[], flashed=[], duration_ms=1.0, t=0.0)))
    play.happens(ChildSaid("application", old, Log("info", "bye")))
    play.happens(ChildExited("application", old, "was killed"))
    assert play.sent("tick") == []
    assert play.sent("log")[0].text == "bye"
    assert play.state is State.APPLICATION_RUNNING


def test_both_spares_can_be_started():
    session = Session(About(version="test"))
    assert [e.kind for e in session.prestart() if isinstance(e, Spawn)] == ["world", "application"]
    assert session.prestart() == []


def test_a_spare_that_dies_is_mentioned_and_not_started_again_at_once():
    play = Play()
    play.command("connect")
    play.effects.clear()
    play.child_dies("application", "ended with exit code 1", "ImportError: rclpy")
    assert "ImportError" in play.sent("log")[0].text
    assert play.did(Spawn) == []
    assert play.reply(play.command("run")) == "ack"


def test_a_session_that_was_started_ahead_waits_longer_for_its_first_client() -> None:
    session = Session(About(version="test", grace_s=5.0, patience_s=100.0), now_s=2.0)
    assert session.deadline_s == 107.0
