"""Steps of the session from rung to rung."""

from __future__ import annotations

import pytest

from executor.session.ladder import TABLE, State
from executor.session.steps import STEPS
from tests.executor.session.play import Play


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
