"""Commands that take no time."""

from __future__ import annotations

from executor.session.immediate import ANSWER_LATER, IMMEDIATE
from executor.session.ladder import TABLE, State
from tests.executor.session.play import Play


def test_every_command_is_a_step_or_immediate() -> None:
    others = {command for command, row in TABLE.items() if not row.is_step} - {"cancel"}
    assert set(IMMEDIATE) == others
    assert set(ANSWER_LATER) < set(IMMEDIATE)


def test_a_speed_is_known_once_the_world_took_it() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    assert play.reply(play.command("set_speed")) == "ack"
    assert play.session.mirror.speed == 2.0


def test_a_command_to_a_process_that_is_gone_is_refused() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    del play.session.children.living["world"]
    assert play.reply(play.command("list_topics")) == "process_died"
