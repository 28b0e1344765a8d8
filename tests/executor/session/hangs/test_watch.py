"""Children that hang: the report after 2 s, the end after 8 s, and cases that are not a hang."""

from __future__ import annotations

import pytest

from executor.child_messages import name_of
from executor.session.events import ChildLooked, ChildTraced, Inspect, Interrupt, Kill, Kind, Spawn, Tell
from executor.session.hangs.watch import LATEST_TRACE_S
from executor.session.ladder import State
from tests.executor.session.play import Play

LOOK_S = 0.25
ACTION = {"file": "actions/A.py", "line": 7, "node_path": "main/A", "node_id": "n1", "text": "A 'main/A'"}
REGEX = """Thread 0x00007f (most recent call first):
  File "/usr/lib/python3.11/threading.py", line 320 in wait

Current thread 0x00007e (most recent call first):
  File "/usr/lib/python3.11/re/__init__.py", line 166 in match
  File "actions/A.py", line 9 in look
  File "actions/A.py", line 5 in update
"""
NODE = {"parent": 0, "type": "A", "kind": "ACTION", "name": "A", "path": "main/A", "node_id": "n1"}


class Watched(Play):
    """A play whose children send beats, unless they are named in `quiet` or `stuck`."""

    def __init__(self):
        super().__init__()
        self.quiet, self.stuck = set(), set()
        self.state_of, self.ran, self.waited, self.task, self.place = {}, {}, {}, {}, {}
        self.deaf = set()
        self.turns = 0

    def goes_on(self, seconds, step_s=LOOK_S):
        """Passes time, with the beats of the children in it."""
        for _ in range(round(seconds / step_s)):
            self.now += step_s
            self.turns += 1
            for kind in list(self.session.children.living):
                self._beats(kind)
                self._is_looked_at(kind)

    def _beats(self, kind):
        if kind in self.quiet:
            return
        turns = 0 if kind in self.stuck else self.turns
        clocks = 0 if kind in self.deaf else self.turns
        more = {"place": self.place[kind]} if kind in self.place else {}
        self.child_says(kind, "beat", turns=turns, task=self.task.get(kind, ""), clocks=clocks, **more)

    def _is_looked_at(self, kind):
        child = self.session.children.get(kind)
        if child is not None:
            seen = self.state_of.get(kind, "S"), self.ran.get(kind, 0.0), self.waited.get(kind, 0.0)
            self.happens(ChildLooked(kind, child.number, *seen))

    @property
    def faults(self):
        return self.sent("fault")


def play_in(state):
    play = Watched()
    play.climb(state)
    play.goes_on(3)
    assert play.faults == []
    play.effects.clear()
    return play


CASES = [(s, k) for s in State if s is not State.IDLE for k in ("world", "application")]


@pytest.mark.parametrize(("state", "kind"), CASES)
def test_a_stopped_process_is_reported_after_2_s_and_ended_after_8(state, kind):
    play = play_in(state)
    number = play.session.children.living[kind].number
    is_used = play.session.children.living[kind].is_in_use
    play.quiet.add(kind)
    play.state_of[kind] = "T"
    play.goes_on(1.5)
    assert play.faults == []
    play.goes_on(1)
    (fault,) = play.faults
    assert fault.kind == "timeout"
    assert fault.message.endswith("has not answered for more than 2 s: its process is stopped.")
    assert ("simulated world" if kind == "world" else "application") in fault.message
    assert play.state is state
    play.goes_on(4)
    assert play.did(Kill) == []
    play.goes_on(2)
    assert play.session.children.living[kind].number > number, "another one waits"
    expected = state
    if is_used:
        expected = State.CONNECTED if kind == "world" else State.VISUALIZATION_READY
        assert "8 s" in play.sent("state-changed")[-1].reason
    assert play.state is expected
    assert len(play.faults) == 1
    play.quiet.clear()
    play.state_of.clear()
    assert play.reply(play.command("run")) == "ack"


def test_a_child_that_recovers_in_time_is_kept():
    play = play_in(State.PAUSED)
    play.quiet.add("world")
    play.goes_on(5)
    assert len(play.faults) == 1
    play.quiet.clear()
    play.goes_on(10)
    assert play.sent("log")[-1].text == "The simulated world answers again."
    assert play.did(Kill) == []
    assert play.state is State.PAUSED
    assert play.reply(play.command("resume")) == "ack"


def test_a_pause_may_last():
    play = play_in(State.PAUSED)
    play.goes_on(60)
    assert (play.faults, play.did(Kill), play.state) == ([], [], State.PAUSED)


def test_delays_of_the_manager_itself_do_not_count():
    play = play_in(State.APPLICATION_RUNNING)
    for _ in range(20):
        play.goes_on(30, step_s=30)  # it was stopped for half a minute, and all events were queued
    play.quiet.add("world")
    play.goes_on(60, step_s=30)
    assert play.faults == []


def test_waiting_for_a_processor_is_no_hang():
    play = play_in(State.APPLICATION_RUNNING)
    play.quiet |= {"world", "application"}
    play.waited |= {"world": 0.2, "application": 0.25}
    play.goes_on(7)
    assert play.faults == []
    play.goes_on(12)
    assert len(play.faults) == 2, "but not even that is waited for without end"


def test_a_world_whose_loop_hangs_is_reported_with_its_line_and_ended():
    play = play_in(State.APPLICATION_RUNNING)
    play.stuck.add("world")
    play.ran["world"] = LOOK_S
    play.place["world"] = {"text": "executor/world/physics/bullet.py:120"}
    play.goes_on(2.5)
    (fault,) = play.faults
    assert "executor/world/physics/bullet.py:120" in fault.message
    play.goes_on(6)
    assert play.state is State.CONNECTED
    assert play.sent("finished")[0].reason == "process_died"


def test_a_slow_tick_is_reported_with_its_node_and_continues():
    play = play_in(State.APPLICATION_RUNNING)
    play.stuck.add("application")
    play.place["application"] = ACTION
    play.goes_on(20)
    (fault,) = play.faults
    assert (fault.node_id, fault.file, fault.line) == ("n1", "actions/A.py", 7)
    assert play.told("world") == ["stop_robot"]
    assert play.state is State.APPLICATION_RUNNING
    play.stuck.clear()
    play.goes_on(1)
    assert play.sent("log")[-1].text == "The application answers again."


@pytest.mark.parametrize("uid", [2, 0])
def test_code_that_holds_the_interpreter_lock_is_found_by_a_signal(uid):
    play = play_in(State.APPLICATION_RUNNING)
    nodes = [NODE | {"uid": 1, "type": "B", "tree_id": "t"}, NODE | {"uid": 2, "tree_id": "t"}]
    play.child_says("application", "tree", nodes=nodes)
    play.quiet.add("application")
    play.ran["application"] = LOOK_S
    play.goes_on(2.25)
    assert play.faults == []
    assert play.did(Inspect) == ["application"]
    play.happens(ChildTraced("application", play.session.children.living["application"].number, REGEX, uid))
    (fault,) = play.faults
    assert (fault.kind, fault.node_id, fault.file, fault.line) == ("timeout", "n1", "actions/A.py", 9)
    assert "main/A" in fault.message
    play.goes_on(7)
    assert play.state is State.VISUALIZATION_READY
    assert len(play.faults) == 1


def test_a_child_that_ignores_the_signal_is_reported_too():
    play = play_in(State.APPLICATION_RUNNING)
    play.quiet.add("application")
    play.goes_on(4)
    assert play.did(Inspect) == ["application"]
    assert "frozen" in play.faults[0].message


def loading(**how):
    """Returns an application that has received its start and does not become ready."""
    play = Watched()
    play.climb(State.VISUALIZATION_READY)
    play.goes_on(3)
    play.obedient = False
    request = play.command("run_application")
    (unpacked,) = Play.answers(play, play.effects[-1])
    play.effects.clear()
    play.happens(unpacked)
    play.child_says("application", "starting")
    play.task["application"] = "loading"
    play.stuck.add("application")
    for name, value in how.items():
        getattr(play, name)["application"] = value
    return play, request


def test_a_setup_that_sleeps_is_named_after_2_s_and_ended_after_8():
    play, request = loading(place=ACTION)
    play.goes_on(2.5)
    assert (play.faults[0].file, play.faults[0].line) == ("actions/A.py", 7)
    assert play.reply(request) is None
    play.goes_on(6)
    assert play.reply(request) == "process_died"
    assert play.state is State.VISUALIZATION_READY
    assert len(play.faults) == 1


def test_a_setup_that_computes_is_reported_and_may_take_a_minute():
    play, request = loading(place=ACTION, ran=0.2)
    play.goes_on(50)
    assert len(play.faults) == 1
    assert play.reply(request) is None
    play.goes_on(11)
    assert play.reply(request) in {"timeout", "process_died"}


def test_computing_outside_of_user_code_is_no_fault_while_loading():
    play, request = loading(ran=0.2)
    play.goes_on(30)
    assert play.faults == []
    assert play.reply(request) is None


def test_waiting_for_the_disk_while_loading_is_no_fault():
    play, request = loading(state_of="D")
    play.quiet.add("application")
    play.goes_on(30)
    assert play.faults == []
    assert play.reply(request) is None


def test_a_process_that_has_not_come_to_its_first_beat_is_judged_by_whether_it_computes():
    play = Watched()
    play.quiet.add("world")
    play.ran["world"] = 0.1
    play.climb(State.CONNECTED)
    play.goes_on(10)
    assert play.faults == []
    play.ran["world"] = 0.0
    play.goes_on(2.5)
    assert len(play.faults) == 1


@pytest.mark.parametrize("way", ["frozen", "dead"])
@pytest.mark.parametrize("kind", ["world", "application"])
def test_a_spare_that_is_lost_as_it_is_needed_is_replaced_once(kind, way):
    play = Watched()
    play.climb(State.CONNECTED)
    play.session.children.replenish()
    play.obedient = False
    request = play.command("run")
    (unpacked,) = (
        a for e in play.effects for a in (Play.answers(play, e) if e.__class__.__name__ == "Unpack" else [])
    )
    play.happens(unpacked)
    other: Kind = "application" if kind == "world" else "world"
    play.child_says(other, "starting")
    play.child_says(other, "ready")
    lost = play.session.children.living[kind].number
    if way == "dead":
        play.child_dies(kind)
    else:
        play.quiet.add(kind)
        play.state_of[kind] = "T"
        play.goes_on(2.5)
        play.quiet.clear()
        play.state_of.clear()
    assert play.session.children.living[kind].number > lost
    play.obedient = True
    number = play.session.children.living[kind].number
    starts = [e for e in play.effects if isinstance(e, Tell) and e.number == number and e.kind == kind]
    assert [name_of(e.message) for e in starts] == ["start"]
    play.child_says(kind, "ready")
    assert play.reply(request) == "ack"
    assert play.state is State.APPLICATION_RUNNING
    assert [f.kind for f in play.faults] == ([] if way == "dead" else ["timeout"])


def test_a_second_spare_that_dies_fails_the_run():
    play = Play(obedient=False)
    run = play.command("run")
    play.child_dies("world")
    assert play.reply(run) is None
    for _ in range(3):
        if "world" in play.session.children.living:
            play.child_dies("world")
    assert play.state is State.CONNECTED


def test_a_spare_that_always_freezes_is_not_started_without_end():
    play = Watched()
    play.climb(State.CONNECTED)
    play.quiet.add("application")
    play.goes_on(120)
    assert 1 < play.did(Spawn).count("application") <= 4


@pytest.mark.parametrize(
    ("state", "command"),
    [
        (State.APPLICATION_RUNNING, "pause"),
        (State.PAUSED, "resume"),
        (State.PAUSED, "step"),
        (State.PAUSED, "reset_world"),
        (State.UNIVERSE_READY, "reset_world"),
        (State.APPLICATION_RUNNING, "set_speed"),
        (State.APPLICATION_RUNNING, "run"),
    ],
)
def test_a_command_is_confirmed_by_the_world_or_fails_saying_so(state, command):
    play = play_in(state)
    play.quiet.add("world")
    play.state_of["world"] = "T"
    answers = play.answers
    play.answers = lambda effect: [] if getattr(effect, "kind", "") == "world" else answers(effect)
    request = play.command(command)
    assert play.reply(request) is None
    play.goes_on(2.5)
    assert play.reply(request) == "not_answering"
    late = play.command(command)
    assert play.reply(late) in {"not_answering", None, "wrong_state"}


def test_a_pause_that_the_world_does_not_confirm_lets_the_application_continue():
    play = play_in(State.APPLICATION_RUNNING)
    play.quiet.add("world")
    answers = play.answers
    play.answers = lambda effect: [] if getattr(effect, "kind", "") == "world" else answers(effect)
    play.command("pause")
    play.goes_on(4)
    assert play.told("application") == ["pause", "resume"]
    assert play.state is State.APPLICATION_RUNNING


def test_the_speed_is_the_one_that_the_world_took():
    play = play_in(State.APPLICATION_RUNNING)
    play.obedient = False
    play.command("set_speed", speed=3.0)
    assert play.session.mirror.speed == 1.0
    (order,) = (e for e in play.effects if isinstance(e, Tell))
    play.child_says("world", "answer", request=getattr(order.message, "request", None))
    assert play.session.mirror.speed == 3.0


def test_without_simulated_time_the_application_is_started_again_once():
    play = play_in(State.APPLICATION_RUNNING)
    play.deaf.add("application")
    play.goes_on(1.5)
    assert play.faults == []
    play.goes_on(1)
    (fault,) = play.faults
    assert "without simulated time" in fault.message
    assert "does not receive it" in fault.message
    assert play.told("application")[-3:] == ["stop", "start", "resume"]
    assert play.state is State.APPLICATION_RUNNING
    play.goes_on(19)
    assert len(play.faults) == 1, "it finds its peers late on a busy machine"
    play.goes_on(3)
    assert len(play.faults) == 2
    assert play.state is State.CONNECTED
    play.deaf.clear()
    assert play.reply(play.command("run")) == "ack"
    play.goes_on(10)
    assert len(play.faults) == 2


def test_a_world_that_publishes_no_time_is_reported():
    play = play_in(State.APPLICATION_RUNNING)
    play.deaf |= {"application", "world"}
    play.goes_on(3)
    assert "the simulated world does not publish it" in play.faults[0].message


def test_a_slow_world_publishes_time_rarely_and_a_paused_one_maybe_never():
    play = play_in(State.APPLICATION_RUNNING)
    play.command("set_speed", speed=0.01)
    play.deaf.add("application")
    play.goes_on(5)
    assert play.faults == []
    play.goes_on(3)
    assert len(play.faults) == 1
    play = play_in(State.PAUSED)
    play.deaf.add("application")
    play.goes_on(60)
    assert play.faults == []


def test_a_process_in_a_debugger_is_left_alone():
    play = play_in(State.APPLICATION_RUNNING)
    play.quiet.add("application")
    play.state_of["application"] = "t"
    play.goes_on(600)
    assert play.faults == []


def test_a_pause_waits_for_a_process_that_is_merely_slow():
    play = play_in(State.APPLICATION_RUNNING)
    answers = play.answers
    play.answers = lambda effect: [] if getattr(effect, "kind", "") == "application" else answers(effect)
    request = play.command("pause")
    play.goes_on(3)
    assert (play.did(Interrupt), play.reply(request)) == ([], None)
    play.child_says("application", "paused")
    assert play.reply(request) == "ack"
    assert play.state is State.PAUSED


def test_a_hang_is_reported_once_at_the_latest_when_its_trace_would_be_there():
    play = play_in(State.APPLICATION_RUNNING)
    play.quiet.add("application")
    play.goes_on(LATEST_TRACE_S + 2 * LOOK_S)
    assert len(play.faults) == 1
