"""An attached session: it follows a program that it did not start and cannot stop."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from executor.session.stage import Stage

__all__ = ["ALLOWED", "Attaching", "refusal"]

ALLOWED: Final = frozenset(
    {
        "cancel",
        "continue_run",
        "control",
        "flag",
        "force",
        "ping",
        "read_recording",
        "release",
        "restart_application",
        "set_breakpoints",
        "subscribe",
        "take_over",
        "unsubscribe",
    }
)
"""The commands of an attached session. Groot2's protocol has no halt, no pause, and no step."""
_REFUSED: Final = (
    "attached",
    "{command} is not possible in an attached session: the program runs by itself.",
    "Groot2's protocol can neither start, pause nor stop a tree; breakpoints and forced results can be set.",
)
_NOT_ATTACHED: Final = ("not_attached", "This session is not attached to another program.", "")


@dataclass
class Attaching:
    """The other program.

    Attributes:
        address: its host and port.
        folder: has the diagrams of its tree.
        controls: whether the user controls the robot.
    """

    address: str
    folder: str
    controls: bool = False


def refusal(stage: Stage, command: str) -> tuple[str, str, str] | None:
    """Returns code, sentence and hint of the refusal of a command; None if it is possible."""
    if stage.attaching is None:
        return _NOT_ATTACHED if command == "control" else None
    if command in ALLOWED:
        return None
    code, message, hint = _REFUSED
    return code, message.format(command=command), hint
