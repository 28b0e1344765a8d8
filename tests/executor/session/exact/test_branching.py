"""Branches of a session: their names, and how they are thrown away."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor import recorder_messages
from executor.session.events import ClientJoined, Send
from executor.session.exact import branching
from tests.executor.session.exact.test_going_back import recorded
from tests.executor.session.exact.test_hosting import told

if TYPE_CHECKING:
    from tests.executor.session.play import Play


def branched() -> tuple[Play, str, str]:
    """Returns a session with a branch, and another one in the present."""
    play = recorded()
    first = play.session.recording.run
    play.command("go_back", t=1.5)
    branch = play.session.recording.run
    play.command("go_back", run=first, t=0.5)
    return play, branch, play.session.recording.run


def test_a_branch_gets_a_name_and_none_again() -> None:
    play, branch, present = branched()
    assert play.reply(play.command("name_branch", run=branch, name="  wider   turns ")) == "ack"
    found = play.session.snapshot().branches
    assert [(each.run, each.name) for each in found] == [(branch, "wider turns"), (present, "")]
    assert play.reply(play.command("name_branch", run=branch, name=" ")) == "ack"
    assert [each.name for each in play.session.snapshot().branches] == ["", ""]


def test_a_branch_is_thrown_away_with_its_recording() -> None:
    play, branch, present = branched()
    assert play.reply(play.command("drop_branch", run=branch)) == "ack"
    assert [each.run for each in play.session.snapshot().branches] == [present]
    assert play.sent("branch")[-1].is_gone
    (drop,) = [m for m in told(play, "recorder") if isinstance(m, recorder_messages.DropRun)]
    assert drop.run == branch
    assert branch not in play.session.snapshot().repeatable_runs
    assert play.reply(play.command("go_back", run=branch)) == "unknown_run"
    assert play.reply(play.command("drop_branch", run=branch)) == "unknown_branch"


def test_the_present_and_what_is_no_branch_stay() -> None:
    play, branch, present = branched()
    assert play.reply(play.command("drop_branch", run=present)) == "present_run"
    first = play.session.snapshot().repeatable_runs[0]
    assert play.reply(play.command("drop_branch", run=first)) == "unknown_branch"
    assert play.reply(play.command("name_branch", run="../..", name="x")) == "unknown_branch"
    assert [each.run for each in play.session.snapshot().branches] == [branch, present]


def test_viewers_get_all_branches() -> None:
    play, branch, present = branched()
    play.happens(ClientJoined("v"))
    assert play.reply(play.command("branches", client="v")) == "ack"
    sent = [e.payload for e in play.effects if isinstance(e, Send) and e.name == "branch" and e.client == "v"]
    assert [each.run for each in sent] == [branch, present]  # type: ignore[attr-defined]
    assert branching.branches
