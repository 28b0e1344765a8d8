"""An attached session begins by itself, allows what the protocol has, and begins again with the program."""

from __future__ import annotations

import pytest

from executor import child_messages, messages
from executor.messages import COMMANDS
from executor.session.debugger.attaching import ALLOWED, Attaching, refusal
from executor.session.events import AttachWanted, ChildSaid, Send, Tell
from executor.session.ladder import State
from tests.executor.session.play import DATA, Play, child_message


@pytest.fixture
def play() -> Play:
    play = Play()
    play.happens(AttachWanted("robot:1667", "/diagrams"))
    return play


def told(play: Play, kind: type) -> list[Tell]:
    return [each for each in play.effects if isinstance(each, Tell) and isinstance(each.message, kind)]


def test_it_begins_by_itself(play: Play) -> None:
    assert play.state is State.APPLICATION_RUNNING
    [start] = told(play, child_messages.StartApplication)
    assert isinstance(start.message, child_messages.StartApplication)
    assert start.message.app_dir == "/diagrams"
    assert play.session.attaching == Attaching("robot:1667", "/diagrams")


def test_what_the_protocol_lacks_is_refused(play: Play) -> None:
    assert set(COMMANDS) >= ALLOWED
    for name in COMMANDS.keys() - ALLOWED:
        request = play.command(name, **DATA.get(name, {}))
        answers = [each for each in play.effects if isinstance(each, Send) and each.request == request]
        assert [each.name for each in answers] == ["error"], name
        error = answers[0].payload
        assert isinstance(error, messages.Error)
        assert error.code == "attached"
        assert play.state is State.APPLICATION_RUNNING


def test_other_sessions_have_no_control() -> None:
    play = Play()
    assert refusal(play.session, "control") is not None
    assert refusal(play.session, "run") is None
    request = play.command("control", on=True)
    [error] = [each.payload for each in play.effects if isinstance(each, Send) and each.request == request]
    assert isinstance(error, messages.Error)
    assert error.code == "not_attached"


def test_a_program_that_was_started_again_is_followed_again_with_control(play: Play) -> None:
    play.command("control", on=True)
    application = play.session.children.get("application")
    assert application is not None
    over = child_message("application", "finished", status="IDLE", reason="process_died", message="again")
    play.happens(ChildSaid("application", application.number, over))
    assert play.state is State.APPLICATION_RUNNING
    assert len(told(play, child_messages.StartApplication)) == 2
    controls = [each.message for each in told(play, child_messages.Control)]
    assert [isinstance(each, child_messages.Control) and each.on for each in controls] == [True, True]


def test_newcomers_get_what_is_known_of_the_program(play: Play) -> None:
    application = play.session.children.get("application")
    assert application is not None
    number = application.number
    shown = child_message(
        "application", "attached_tree", name="n", main_tree="Main", files={}, actions=[], xml="<root/>"
    )
    state = child_message("application", "attached", address="robot:1667", state="following", age_s=0.1)
    play.happens(ChildSaid("application", number, shown))
    play.happens(ChildSaid("application", number, state))
    snapshot = play.session.snapshot()
    assert snapshot.attached_tree is not None
    assert snapshot.attached_tree.main_tree == "Main"
    assert snapshot.attached is not None
    assert snapshot.attached.state == "following"
