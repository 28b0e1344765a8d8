"""Commands that take no time."""

from __future__ import annotations

from dataclasses import replace

from executor.child_messages import Pause, Reset, Resume, ServeGroot2, StartApplication
from executor.messages import Groot2
from executor.session.events import Tell
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


def test_a_message_is_published_only_while_time_passes() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    assert play.reply(play.command("publish_topic")) == "world_paused"
    assert play.reply(play.command("run_world")) == "ack"
    assert play.reply(play.command("publish_topic")) == "ack"
    assert play.reply(play.command("terminate_application")) == "ack"
    assert play.reply(play.command("publish_topic")) == "world_paused"
    play.climb(State.APPLICATION_RUNNING)
    assert play.reply(play.command("publish_topic")) == "ack"
    play.command("pause")
    assert play.reply(play.command("publish_topic")) == "world_paused"


def test_a_world_that_runs_alone_waits_for_the_application() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    play.command("run_world")
    play.effects.clear()
    play.command("run")
    told = [
        type(effect.message) for effect in play.effects if isinstance(effect, Tell) and effect.kind == "world"
    ]
    assert told.index(Pause) < told.index(Reset) < told.index(Resume)
    assert not play.session.run.is_world_alone


def _served(play: Play) -> list[int]:
    """Returns the ports for Groot2 that the application received."""
    told = [effect.message for effect in play.effects if isinstance(effect, Tell)]
    started = [each.groot2 for each in told if isinstance(each, StartApplication)]
    return started + [each.port for each in told if isinstance(each, ServeGroot2)]


def test_groot2_looks_at_a_run_and_at_those_to_come_until_it_is_switched_off() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    assert play.reply(play.command("serve_groot2")) == "ack"
    assert play.session.mirror.snapshot().groot2 == Groot2(1667)
    play.climb(State.APPLICATION_RUNNING)
    assert _served(play) == [1667]
    assert play.reply(play.command("serve_groot2", port=0)) == "ack"
    assert _served(play) == [1667, 0]
    assert play.session.mirror.snapshot().groot2 == Groot2(0)
    play.effects.clear()
    play.climb(State.APPLICATION_RUNNING)
    assert set(_served(play)) == {0}


def test_groot2_does_not_reach_an_isolated_session() -> None:
    play = Play()
    play.session.about = replace(play.session.about, ros_environment={})
    assert play.reply(play.command("serve_groot2")) == "isolated"
    assert play.session.mirror.snapshot().groot2 is None
