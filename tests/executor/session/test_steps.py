"""Steps of the session from rung to rung."""

from __future__ import annotations

from typing import Any, Final, TypeGuard

import pytest

from executor import child_messages
from executor.session.events import Tell, Unpack, Unpacked
from executor.session.ladder import TABLE, State
from executor.session.steps import STEPS
from tests.executor.session.play import APPLICATION, Play

REFUSED: Final[dict[str, Any]] = {"code": "not_applied", "message": "It is no tree.", "hint": "Mend it."}


def test_every_step_of_the_table_is_there() -> None:
    assert set(STEPS) == {command for command, row in TABLE.items() if row.is_step}


@pytest.mark.parametrize("state", list(State))
def test_a_disconnection_ends_everything(state: State) -> None:
    play = Play()
    play.climb(state)
    assert play.reply(play.command("disconnect")) == "ack"
    assert play.state is State.IDLE
    assert play.session.children.living.keys() <= {"world", "application"}


def test_a_run_climbs_all_rungs_at_once() -> None:
    play = Play()
    assert play.reply(play.command("run")) == "ack"
    assert [change.state for change in play.sent("state-changed")][-1] == State.APPLICATION_RUNNING


def test_a_paused_run_runs_on_with_a_changed_tree() -> None:
    play = Play()
    play.climb(State.PAUSED)
    assert play.reply(play.command("run_on", app_zip_base64="bmV3")) == "ack"
    assert play.state is State.APPLICATION_RUNNING
    told = play.told("application")
    assert told.index("apply") < len(told) - 1 - told[::-1].index("resume")
    assert play.session.run.application is not None
    assert play.session.run.application.app_zip_base64 == "bmV3"


def test_without_a_tree_it_runs_on_as_it_is() -> None:
    play = Play()
    play.climb(State.PAUSED)
    assert play.reply(play.command("run_on", app_zip_base64="")) == "ack"
    assert play.state is State.APPLICATION_RUNNING
    assert "apply" not in play.told("application")


def test_a_run_stays_as_it_is_where_its_changed_tree_is_refused() -> None:
    play = Play()
    play.climb(State.PAUSED)
    play.obedient = False
    request = play.command("run_on", app_zip_base64="bmV3")
    (unpack,) = [effect for effect in play.effects if isinstance(effect, Unpack)][-1:]
    play.happens(Unpacked(unpack.token, "/elsewhere"))
    (apply,) = [e.message for e in play.effects if isinstance(e, Tell) and is_apply(e.message)]
    resumed = play.told("application").count("resume")
    play.child_says("application", "answer", request=apply.request, error=REFUSED)
    assert play.reply(request) == "not_applied"
    assert play.state is State.PAUSED
    assert play.told("application").count("resume") == resumed
    assert play.session.run.application is not None
    assert play.session.run.application.app_zip_base64 == APPLICATION["app_zip_base64"]


def test_an_archive_that_cannot_be_unpacked_changes_nothing() -> None:
    play = Play()
    play.climb(State.PAUSED)
    play.obedient = False
    request = play.command("run_on", app_zip_base64="!")
    (unpack,) = [effect for effect in play.effects if isinstance(effect, Unpack)][-1:]
    play.happens(Unpacked(unpack.token, "", error="it is no archive"))
    assert play.reply(request) == "bad_archive"
    assert play.state is State.PAUSED


def is_apply(message: object) -> TypeGuard[child_messages.ApplyApplication]:
    return isinstance(message, child_messages.ApplyApplication)
