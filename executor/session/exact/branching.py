"""The commands for branches: runs of the session that continue others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import structs

from executor import messages, recorder_messages

if TYPE_CHECKING:
    from executor.recording_events import Branch
    from executor.session.events import CommandCame
    from executor.session.stage import Stage

__all__ = ["branches", "drop_branch", "name_branch", "throw_away"]


def branches(stage: Stage, event: CommandCame, _: messages.Empty) -> None:
    """Sends a client all branches."""
    for branch in stage.mirror.branches:
        stage.output.send(event.client, branch)


def name_branch(stage: Stage, event: CommandCame, data: messages.NameBranch) -> None:
    """Gives a branch a name; one of spaces is none."""
    if (branch := _found(stage, event, data.run)) is None:
        return
    name = " ".join(data.name.split())
    stage.output.emit(structs.replace(branch, name=name))
    stage.output.send(event.client, messages.Ack(), event.request)


def drop_branch(stage: Stage, event: CommandCame, data: messages.DropBranch) -> None:
    """Throws a branch away, with its recording and all that is needed to go back in it."""
    if _found(stage, event, data.run) is None:
        return
    if stage.recording.run == data.run:
        text = "This branch is the run of the present."
        stage.output.refuse(event, "present_run", text, "Go back in another run first, or press Run.")
        return
    throw_away(stage, data.run)
    stage.output.send(event.client, messages.Ack(), event.request)


def throw_away(stage: Stage, run: str) -> None:
    """Throws a branch away that is not the run of the present."""
    stage.past.drop(run)
    stage.children.tell_recorder(recorder_messages.DropRun(run))
    for branch in [each for each in stage.mirror.branches if each.run == run]:
        stage.output.emit(structs.replace(branch, is_gone=True))


def _found(stage: Stage, event: CommandCame, run: str) -> Branch | None:
    """Returns a branch; refuses a command for one that is not there."""
    branch = next((each for each in stage.mirror.branches if each.run == run), None)
    if branch is None:
        stage.output.refuse(event, "unknown_branch", "This session has no such branch.")
    return branch
