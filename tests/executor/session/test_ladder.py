"""The ladder as a table."""

from __future__ import annotations

import pytest

from executor.messages import COMMANDS
from executor.session.ladder import TABLE, State, is_legal, where


def test_every_command_of_the_protocol_has_its_row() -> None:
    assert set(TABLE) == set(COMMANDS)


def test_a_paused_run_is_as_high_as_a_running_one() -> None:
    assert State.PAUSED.height == State.APPLICATION_RUNNING.height
    assert State.PAUSED.reaches(State.UNIVERSE_READY)
    assert not State.CONNECTED.reaches(State.UNIVERSE_READY)


@pytest.mark.parametrize(
    ("command", "states"), [("resume", "paused"), ("connect", "idle"), ("run", ", ".join(State))]
)
def test_a_command_names_the_states_in_which_it_is_legal(command: str, states: str) -> None:
    assert where(command) == states
    assert [state for state in State if is_legal(state, command)] == states.split(", ")
