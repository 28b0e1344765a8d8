"""The Python debugger of a session: who may use it, holds at a line, and their end."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest

from executor import adapter_messages
from executor.session.debugger.python import HELD_IN_PYTHON
from executor.session.events import (
    ChildLooked,
    ChildSaid,
    ClientJoined,
    RecordingWanted,
    Retire,
    Tell,
)
from executor.session.ladder import State
from tests.executor.session.play import APPLICATION, HELD, UNIVERSE, Play

EXACT: dict[str, Any] = {"universe": {**UNIVERSE, "time": "exact"}, "application": APPLICATION}


class Debugged(Play):
    """A session whose driver debugs Python."""

    def ask(self, command: str, client: str = "d", seq: int = 5, **arguments: Any) -> str | None:
        message = {"seq": seq, "type": "request", "command": command, "arguments": arguments}
        return self.reply(self.command("dap", client, message=message))

    def adapter_says(self, **message: Any) -> None:
        number = self.session.children.living["adapter"].number
        text = adapter_messages.AdapterText(msgspec.json.encode(message))
        self.happens(ChildSaid("adapter", number, text))

    def adapter_tells(self, event: str, **body: Any) -> None:
        self.adapter_says(seq=1, type="event", event=event, body=body)

    def passed_on(self) -> list[dict[str, Any]]:
        return [
            msgspec.json.decode(each.message.text)
            for each in self.effects
            if isinstance(each, Tell) and isinstance(each.message, adapter_messages.AdapterText)
        ]

    def messages(self, client: str = "d") -> list[dict[str, Any]]:
        return [each.message for each in self.sent("dap", client)]

    def events(self, client: str = "d") -> list[str]:
        return [each["event"] for each in self.messages(client) if each["type"] == "event"]

    def begin(self) -> None:
        self.climb(State.APPLICATION_RUNNING)
        assert self.ask("initialize") == "ack"
        self.adapter_tells("debugpyWaitingForServer", host="127.0.0.1", port=4711)
        self.adapter_tells("initialized")
        assert self.ask("configurationDone") == "ack"

    def stop(self) -> None:
        self.adapter_tells("stopped", reason="breakpoint", threadId=1)


def told(play: Play, kind: str) -> list[Any]:
    return [each.message for each in play.effects if isinstance(each, Tell) and each.kind == kind]


def test_each_application_gets_an_adapter_of_its_own():
    play = Debugged()
    assert play.ask("initialize") == "ack"
    [answer] = play.messages()
    assert (answer["success"], answer["request_seq"]) == (True, 5)
    assert answer["body"]["supportsLogPoints"]
    assert "adapter" not in play.session.children.living
    assert play.ask("threads") == "ack"
    assert play.messages()[-1]["success"] is False, "nothing runs"
    play.climb(State.APPLICATION_RUNNING)
    assert [each["command"] for each in play.passed_on()] == ["initialize", "attach"]
    assert play.passed_on()[1]["arguments"] == {
        "connect": {"host": "127.0.0.1", "port": 0},
        "justMyCode": True,
        "redirectOutput": False,
        "subProcess": False,
    }
    [start] = [e.message for e in play.effects if isinstance(e, Tell) and e.kind == "application"][:1]
    assert start.is_debugged  # type: ignore[union-attr]
    play.adapter_tells("debugpyWaitingForServer", host="127.0.0.1", port=4711)
    assert "connect_debugger" in play.told("application")
    assert play.events() == []
    play.adapter_tells("initialized")
    first = play.session.children.living["adapter"].number
    assert play.reply(play.command("restart_application")) == "ack"
    assert play.session.children.living["adapter"].number != first
    assert play.events() == ["initialized", "terminated"]


def test_a_stop_holds_world_and_ladder_and_only_the_driver_sees_the_line():
    play = Debugged()
    play.happens(ClientJoined("v"))
    play.begin()
    play.stop()
    assert play.state is State.HELD
    assert play.told("world")[-1] == "pause"
    assert play.sent("held") == [], "it is held at no node"
    assert play.messages("v") == []
    assert play.ask("continue", threadId=1) == "ack"
    play.adapter_tells("continued", threadId=1)
    assert (play.state, play.told("world")[-1]) == (State.APPLICATION_RUNNING, "resume")


def test_a_step_lets_the_world_continue_once_it_has_left_the_tick():
    play = Debugged()
    play.begin()
    play.child_says("application", "beat", turns=7)
    play.stop()
    play.ask("next", threadId=1)
    play.adapter_tells("continued", threadId=1)
    play.child_says("application", "beat", turns=7)
    assert (play.state, play.told("world")[-1]) == (State.HELD, "pause")
    play.child_says("application", "beat", turns=8)
    assert (play.state, play.told("world")[-1]) == (State.APPLICATION_RUNNING, "resume")


def test_a_stop_within_a_hold_of_the_tree_leaves_the_tree_held():
    play = Debugged()
    play.begin()
    play.child_says("application", "held", **HELD)
    play.stop()
    play.ask("continue", threadId=1)
    play.adapter_tells("continued", threadId=1)
    assert (play.state, play.told("world")[-1]) == (State.HELD, "pause")


def test_a_program_that_is_stopped_does_not_hang():
    play = Debugged()
    play.begin()
    play.stop()
    number = play.session.children.living["application"].number
    for _ in range(100):
        play.now += 0.25
        play.child_says("application", "beat", turns=7, place={"text": "x", "file": "actions/A.py"})
        play.happens(ChildLooked("application", number, "S", 0.0, 0.0))
    assert (play.sent("fault"), play.state) == ([], State.HELD)
    for _ in range(100):
        play.now += 0.25
        play.happens(ChildLooked("application", number, "T", 0.0, 0.0))
    assert play.sent("fault")[0].kind == "timeout"
    assert play.state is not State.HELD


@pytest.mark.parametrize(("time", "reply"), [("exact", "held_in_python"), ("live", "ack")])
def test_a_world_in_the_stopped_process_answers_nothing(time: str, reply: str):
    play = Debugged()
    run: dict[str, Any] = {"universe": {**UNIVERSE, "time": time}, "application": APPLICATION}
    assert play.reply(play.command("run", **run)) == "ack"
    assert play.ask("initialize") == "ack"
    play.adapter_tells("initialized")
    assert play.ask("configurationDone") == "ack"
    play.stop()
    assert play.state is State.HELD
    for command in ("list_topics", "echo_topic"):
        assert play.reply(play.command(command)) == reply


def test_only_the_driver_debugs_and_who_takes_over_ends_it():
    play = Debugged()
    play.happens(ClientJoined("v"))
    assert play.ask("initialize", "v") == "not_driver"
    play.begin()
    play.stop()
    assert play.reply(play.command("take_over", "v")) == "ack"
    assert play.did(Retire) == ["adapter"]
    assert (play.events()[-1], play.state) == ("terminated", State.APPLICATION_RUNNING)
    assert play.ask("variables", "v") == "not_initialized"
    assert play.ask("variables", "d") == "not_driver"


def test_a_page_that_is_loaded_again_finds_the_stop():
    play = Debugged()
    play.begin()
    play.stop()
    assert play.ask("initialize") == "ack"
    assert play.events() == ["initialized", "stopped", "initialized", "stopped"]
    count = len(play.passed_on())
    assert play.ask("configurationDone") == "ack"
    assert (len(play.passed_on()), play.state) == (count, State.HELD), "it is configured already"


def test_a_hold_that_lasts_too_long_ends_and_so_does_the_debugger():
    play = Debugged()
    play.begin()
    play.stop()
    play.later(play.session.about.hold_limit_s + 1)
    assert (play.state, play.did(Retire)) == (State.APPLICATION_RUNNING, ["adapter"])
    assert "all breakpoints are off" in play.sent("log")[-1].text


def test_an_adapter_that_ends_is_reported_and_can_be_started_again():
    play = Debugged()
    play.begin()
    play.stop()
    play.child_dies("adapter")
    assert (play.state, play.events()[-1]) == (State.APPLICATION_RUNNING, "terminated")
    assert "The Python debugger was killed by SIGKILL" in play.sent("log")[-1].text
    assert "adapter" not in play.session.children.living
    assert play.ask("initialize") == "ack"
    assert "adapter" in play.session.children.living


def test_a_pause_and_a_stop_while_the_program_is_stopped():
    play = Debugged()
    play.begin()
    play.stop()
    assert play.reply(play.command("pause")) == "ack"
    assert play.state is State.HELD
    assert play.reply(play.command("set_breakpoints")) == "ack"
    assert play.reply(play.command("continue_run")) == HELD_IN_PYTHON
    assert play.reply(play.command("terminate_application")) == "ack"
    assert play.state is State.VISUALIZATION_READY


def test_a_step_from_a_pause_that_stops_at_a_line_returns_to_the_pause():
    play = Debugged()
    play.begin()
    assert play.reply(play.command("pause")) == "ack"
    play.obedient = False
    step = play.command("step")
    play.stop()
    assert (play.reply(step), play.state) == ("ack", State.HELD)
    play.ask("continue", threadId=1)
    play.adapter_tells("continued", threadId=1)
    assert play.state is State.PAUSED


def test_a_program_that_nothing_can_stop_is_not_traced():
    play = Debugged()
    play.begin()
    assert play.told("application")[-1] == "trace_python"
    play.ask("setBreakpoints", source={"path": "a.py"}, breakpoints=[{"line": 1}])
    play.ask("setExceptionBreakpoints", filters=["raised"])
    play.ask("setBreakpoints", source={"path": "a.py"}, breakpoints=[])
    play.ask("setExceptionBreakpoints", filters=[])
    traced = [e.message.is_on for e in play.effects if isinstance(e, Tell) and hasattr(e.message, "is_on")]
    assert traced == [False, True, False]


def test_what_is_changed_by_hand_is_said():
    play = Debugged()
    play.begin()
    play.stop()
    play.ask("setVariable", name="n", value="3", variablesReference=1)
    assert play.sent("log")[-1].text == "Changed by hand in Python: n = 3"


@pytest.mark.parametrize(
    ("command", "arguments", "is_change"),
    [
        ("setVariable", {"name": "n", "value": "3", "variablesReference": 1}, True),
        ("evaluate", {"expression": "self.n.clear()", "frameId": 1, "context": "watch"}, True),
        ("evaluate", {"expression": "n = 3", "context": "repl"}, True),
        ("evaluate", {"expression": "self.n", "frameId": 1, "context": "hover"}, False),
        ("variables", {"variablesReference": 1}, False),
        ("completions", {"text": "self.", "column": 6, "frameId": 1}, False),
        ("next", {"threadId": 1}, False),
    ],
)
def test_each_kind_of_change_in_python_ends_the_way_back(
    command: str, arguments: dict[str, Any], is_change: bool
):
    play = Debugged()
    play.happens(RecordingWanted("/records"))
    assert play.reply(play.command("run", **EXACT)) == "ack"
    play.ask("initialize")
    play.adapter_tells("initialized")
    play.ask("configurationDone")
    play.child_says("application", "fingerprints", data=b"12345678" * 9)
    play.child_says("application", "tick", n=7, t=0.5, changed=[], flashed=[], duration_ms=1.0)
    play.child_says("application", "beat", turns=7, ticks=8)
    play.stop()
    assert play.ask(command, **arguments) == "ack"
    run = play.session.recording.run
    assert play.sent("repeatable_runs")[-1].by_hand == ({run: 0.5} if is_change else {})
    assert play.session.snapshot().runs_by_hand == play.sent("repeatable_runs")[-1].by_hand
    for t_s in (0.5, None):
        reply = play.reply(play.command("go_back", t=t_s))
        assert reply == ("changed_by_hand" if is_change else "ack")
        if not is_change:
            return
    assert play.reply(play.command("go_back", t=0.49)) == "ack"
    [again] = [m for m in told(play, "application") if getattr(m, "replay", None) is not None]
    assert len(again.replay.fingerprints) == 7 * 8, "the eighth tick is the changed one"


@pytest.mark.parametrize("goes_on", ["", "continue", "next"])
def test_the_first_beat_after_a_change_says_which_ticks_were_whole_before(goes_on: str):
    play = Debugged()
    assert play.reply(play.command("run", **EXACT)) == "ack"
    play.ask("initialize")
    play.adapter_tells("initialized")
    play.ask("configurationDone")
    play.child_says("application", "beat", turns=7, ticks=8)
    play.stop()
    assert play.ask("evaluate", expression="len(self.path)", frameId=1, context="watch") == "ack"
    run = play.session.past.find("")
    assert run is not None
    play.child_says("application", "log", level="info", text="its last words before the stop")
    assert run.by_hand_ticks == 7, "the last beat is older than the stop"
    if goes_on:
        play.ask(goes_on, threadId=1)
    for ticks in (11, 15):
        play.child_says("application", "beat", turns=7, ticks=ticks)
        assert run.by_hand_ticks == (7 if goes_on else 10)


def test_a_program_that_runs_evaluates_nothing():
    play = Debugged()
    play.begin()
    for command in ("evaluate", "setVariable"):
        assert play.ask(command, expression="n = 3", context="repl") == "ack"
        answer = play.messages()[-1]
        assert (answer["success"], answer["message"]) == (
            False,
            "The program is not held at a line of Python.",
        )
    assert "evaluate" not in [each["command"] for each in play.passed_on()]


def test_an_attach_that_fails_is_said():
    play = Debugged()
    play.climb(State.APPLICATION_RUNNING)
    play.ask("initialize")
    attach = play.passed_on()[-1]
    play.adapter_says(seq=2, type="response", request_seq=attach["seq"], success=False, message="too late")
    assert play.sent("log")[-1].text == "The Python debugger is not connected: too late"
    assert play.did(Retire) == ["adapter"]


def test_bytes_of_the_adapter_that_are_no_message_are_dropped():
    play = Debugged()
    play.begin()
    number = play.session.children.living["adapter"].number
    for text in (b"{", b"[]", b'{"type": "event"}', b'{"type": "response", "request_seq": "x"}', b"\xff"):
        play.happens(ChildSaid("adapter", number, adapter_messages.AdapterText(text)))
    assert play.state is State.APPLICATION_RUNNING


def test_a_breakpoint_with_more_than_a_line_is_one_condition_and_its_count_begins_again():
    play = Debugged()
    play.begin()
    line = {"line": 3, "condition": "n", "hitCondition": ">=2"}
    for _ in range(2):
        play.ask("setBreakpoints", source={"path": "actions/Act.py"}, breakpoints=[{"line": 2}, line])
    [first, second] = [each["arguments"] for each in play.passed_on() if each["command"] == "setBreakpoints"]
    assert first["breakpoints"][0] == {"line": 2}
    assert first["breakpoints"][1].keys() == {"line", "condition"}
    assert "'actions/Act.py', 3), 'n', 2" in first["breakpoints"][1]["condition"]
    assert first["breakpoints"][1] != second["breakpoints"][1]


def test_what_a_breakpoint_cannot_evaluate_is_reported_to_all_and_at_its_line():
    play = Debugged()
    play.begin()
    play.child_says("application", "python_line_wrong", path="actions/Act.py", line=3, text="No name “n”.")
    assert play.sent("log")[-1].text == "actions/Act.py:3: No name “n”."
    told = play.messages()[-1]
    assert (told["event"], told["body"]["breakpoint"]) == (
        "breakpoint",
        {"verified": False, "message": "No name “n”.", "source": {"path": "actions/Act.py"}, "line": 3},
    )
