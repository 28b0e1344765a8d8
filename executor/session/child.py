"""State of one child process, derived from its messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeVar

from msgspec import Struct

from executor.child_messages import (
    Answer,
    ApplicationReady,
    Attached,
    AttachedTree,
    Beat,
    Blackboard,
    Failed,
    Fault,
    FromExact,
    FromWorld,
    Log,
    Sim,
    Starting,
    Tick,
    Tree,
    WorldReady,
)
from executor.recorder_messages import Recorded
from executor.session.hangs.vitals import Vitals

if TYPE_CHECKING:
    from executor.adapter_messages import FromAdapter
    from executor.evaluation_messages import FromEvaluation
    from executor.recorder_messages import FromRecorder
    from executor.session.events import Kind

    Noted = FromWorld | FromExact | FromRecorder | FromEvaluation | FromAdapter

__all__ = ["Child"]

Message = TypeVar("Message", bound=Struct)

_TASKS: Final[dict[type[Struct], str]] = {Starting: "loading", WorldReady: "", ApplicationReady: ""}
"""The task of a child's main thread after it sent one of these messages."""
_ACCEPTED: Final = frozenset({Starting, WorldReady, ApplicationReady, Failed, Fault})
"""Messages that prove that a child received its start message."""
_NOT_STORED: Final = (Tick, Log, Blackboard, Tree, Attached, AttachedTree, Sim, Answer, Beat, Recorded)


class Child:
    """A world or an application process.

    A child is spawned before it is needed (a spare). It is in use from the time when it received its start
    message; before, it runs none of the user's code, and another process can replace it.

    Attributes:
        hang: the message of the fault that reported its hang; "" while it does not hang.
        is_exact: whether it is the process of an exact run, which also has its world.
        is_holding: whether it holds its tree at a node.
        is_suspended: whether a Python debugger holds its main thread at a line.
    """

    def __init__(self, kind: Kind, number: int, now_s: float = 0.0, *, is_exact: bool = False) -> None:
        self.kind = kind
        self.number = number
        self.is_exact = is_exact
        self.is_started = False
        self.is_stopping = False
        self.is_alive = True
        self.exit_reason = ""
        self.last_lines: tuple[str, ...] = ()
        self.vitals = Vitals(now_s)
        self.hang = ""
        self.is_holding = False
        self.is_suspended = False
        self.was_inspected = False
        self._said: dict[type[Struct], Noted] = {}
        self._answers: dict[str, Answer | None] = {}

    @property
    def key(self) -> tuple[Kind, int]:
        """Kind and number of the child."""
        return self.kind, self.number

    @property
    def is_in_use(self) -> bool:
        """Whether the child has received its start message."""
        return self.is_started and not self._said.keys().isdisjoint(_ACCEPTED)

    @property
    def hanging_node(self) -> str:
        """The place in the user's code where the main thread was last seen."""
        return self.vitals.place.text if self.vitals.is_in_action else ""

    @property
    def is_hanging(self) -> bool:
        """Whether the child's hang was reported and the child has not recovered since."""
        return bool(self.hang) and not self.vitals.is_well

    @property
    def hanging_s(self) -> float:
        """The time in s for which its main thread has hung, if that was reported; else 0."""
        return max(self.vitals.stuck_s, self.vitals.silent_s) if self.is_hanging else 0.0

    def expect(self, token: str) -> None:
        """Stores the token of a request that the session itself sent, to recognise the answer."""
        self._answers[token] = None

    def take_answer(self, message: Answer) -> bool:
        """Stores an answer to a request of the session itself.

        Returns False if it answers another request.
        """
        if message.request is None or message.request not in self._answers:
            return False
        self._answers[message.request] = message
        return True

    def answer(self, token: str) -> Answer | None:
        """Returns the answer to a request of the session itself; None if it has not arrived yet."""
        return self._answers.get(token)

    def note(self, message: Noted) -> None:
        """Notes a message: updates the signs of life, and stores the last message of each type."""
        self.vitals.heard(from_main=not isinstance(message, Beat | Log))
        if isinstance(message, Beat):
            self.vitals.beat(message)
        elif type(message) in _TASKS:
            self.vitals.task = _TASKS[type(message)]  # set here, since a hang may prevent the next beat
        if isinstance(message, Fault) and message.kind == "timeout":
            pass  # a tick that is only slow may still end normally
        elif not isinstance(message, _NOT_STORED):
            self._said[type(message)] = message

    def said(self, kind: type[Message]) -> Message | None:
        """Returns the last message of a type that was stored since `forget`; None if there is none."""
        message = self._said.get(kind)
        return message if isinstance(message, kind) else None

    def forget(self, kind: type[Struct]) -> None:
        """Removes the stored message of a type, before the session waits for a new one."""
        self._said.pop(kind, None)

    def end(self, reason: str, last_lines: tuple[str, ...] = ()) -> None:
        """Marks the process as ended."""
        self.is_alive = False
        self.exit_reason = reason
        self.last_lines = last_lines
