"""The messages from outside that change an exact run.

Pauses, steps and speeds are none: they do not change what happens. Breakpoints are, since what enters while
the tree is held has its place at a stop of the debugger.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor import child_messages

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.child_messages import ToExact

__all__ = ["done_by", "input_of", "noted"]

_OF_TREE: Final = (
    child_messages.SetTickRate,
    child_messages.SetBlackboard,
    child_messages.SetPort,
    child_messages.SetBreakpoints,
    child_messages.Continue,
    child_messages.ForceResult,
    child_messages.ReleaseForced,
)
_OF_WORLD: Final = (
    child_messages.Reset,
    child_messages.StopRobot,
    child_messages.Teleop,
    child_messages.MoveBody,
    child_messages.PublishTopic,
)


_NOTED: Final = (
    child_messages.Teleop,
    child_messages.MoveBody,
    child_messages.PublishTopic,
)
"""What is recorded as an input of a world. The tree's are recorded where they are carried out."""


def noted(command: Struct) -> dict[str, Any] | None:
    """Returns what the recording says about a command for a world; None if nothing here."""
    return done_by(command) if isinstance(command, _NOTED) else None


def done_by(command: Struct) -> dict[str, Any]:
    """Returns what a command says, without what only the channel uses."""
    data: dict[str, Any] = msgspec.to_builtins(command)
    return {key: value for key, value in data.items() if key not in ("type", "request")}


def input_of(message: ToExact) -> Struct | None:
    """Returns the command that changes the run; None if the message does not."""
    match message:
        case child_messages.ForWorld(command=command):
            return command if isinstance(command, _OF_WORLD) else None
        case child_messages.ApplyApplication(dry=dry):
            return None if dry else message
        case _:
            return message if isinstance(message, _OF_TREE) else None
