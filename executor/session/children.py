"""The child processes of a session: starts them, sends them messages, and ends them."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from executor import child_messages
from executor.session.child import Child
from executor.session.events import Interrupt, Kill, Retire, Spawn, Tell, WakeSnapshot

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.adapter_messages import ToAdapter
    from executor.child_messages import Request, ToApplication, ToExact, ToWorld
    from executor.evaluation_messages import ToEvaluation
    from executor.recorder_messages import FindKeyframe, ReadSegment, ToRecorder
    from executor.session.events import ChildExited, ChildLooked, ChildSaid, ChildTraced, Effect, Kind

    Told = ToWorld | ToExact | ToRecorder | ToEvaluation | ToAdapter

__all__ = ["Children"]


class Children:
    """Manages the world and the application: at most one living child of each kind.

    `LaunchNodes` manages other processes.

    Args:
        effect: is called with each effect to carry out.
        clock: returns the time of the session in s.
        token: makes the token of a request.
        lost: called with a child that is dropped and the reason, before the child is ended.

    Attributes:
        wants_exact: whether the next application is an exact run.
        host: the application that has the world in it; None while the world's own process has it.
    """

    def __init__(
        self,
        effect: Callable[[Effect], None],
        clock: Callable[[], float],
        token: Callable[[], str],
        lost: Callable[[Child, str], None],
    ) -> None:
        self._effect = effect
        self._clock = clock
        self._token = token
        self._lost = lost
        self._count = 0
        self.living: dict[Kind, Child] = {}
        self.leaving: set[tuple[Kind, int]] = set()
        self.spares_lost: Counter[Kind] = Counter()
        self.wants_exact = False
        self.host: Child | None = None

    def next_number(self) -> int:
        """Returns the number of a new child."""
        self._count += 1
        return self._count

    def get(self, kind: Kind) -> Child | None:
        """Returns the living child of a kind, or None."""
        return self.living.get(kind)

    def of(self, event: ChildSaid | ChildLooked | ChildTraced | ChildExited) -> Child | None:
        """Returns the living child that an event is about; None if it is about an earlier one."""
        child = self.living.get(event.kind)
        return child if child is not None and child.number == event.number else None

    def ensure(self, kind: Kind) -> Child:
        """Returns the living child of a kind; starts one if there is none.

        A spare application is replaced where it is not of the kind of run that is wanted.
        """
        is_exact = (kind == "application" and self.wants_exact) or kind in ("trying", "source")
        spare = self.living.get(kind)
        if (
            kind == "application"
            and spare is not None
            and not spare.is_started
            and spare.is_exact != is_exact
        ):
            self.drop(kind)
        if kind not in self.living:
            self.living[kind] = Child(kind, self.next_number(), self._clock(), is_exact=is_exact)
            self._effect(Spawn(kind, self._count, is_exact=is_exact))
        return self.living[kind]

    def wake(self, snapshot: tuple[int, int], kind: Kind = "application") -> Child:
        """Makes a copy of a snapshot the child of a kind, in place of a spare."""
        self.drop(kind)
        child = self.living[kind] = Child(kind, self.next_number(), self._clock(), is_exact=True)
        child.is_started = True
        self._effect(WakeSnapshot(*snapshot, child.number, kind))
        return child

    def holder(self, kind: Kind) -> Child | None:
        """Returns the living child that does the work of a kind: an exact run has the world in it."""
        return self.host if kind == "world" and self.host is not None else self.living.get(kind)

    def replenish(self) -> None:
        """Starts a spare process of each kind, since their imports take time."""
        self.ensure("world")
        self.ensure("application")

    def tell_world(self, message: ToWorld) -> None:
        """Sends a message to the world, if there is one."""
        self._tell("world", message)

    def tell_application(self, message: ToApplication) -> None:
        """Sends a message to the application, if there is one."""
        self._tell("application", message)

    def tell_exact(self, child: Child, message: ToExact) -> None:
        """Sends a message to an exact run."""
        self._effect(Tell(child.kind, child.number, message))

    def tell_host(self, message: ToExact) -> None:
        """Sends a message to the exact run that has the world in it, if there is one."""
        if self.host is not None:
            self.tell_exact(self.host, message)

    def tell_recorder(self, message: ToRecorder) -> None:
        """Sends a message to the recorder, if there is one."""
        self._tell("recorder", message)

    def tell_evaluation(self, message: ToEvaluation) -> None:
        """Sends a message to the process of an evaluation, if there is one."""
        self._tell("evaluation", message)

    def tell_adapter(self, message: ToAdapter) -> None:
        """Sends a message to debugpy's adapter, if there is one."""
        self._tell("adapter", message)

    def ask(self, kind: Kind, message: Request | ReadSegment | FindKeyframe, token: str) -> None:
        """Sends a request to the holder of a kind; its answer will have the same token."""
        message.request = token
        self._tell(kind, message)

    def order(self, kind: Kind, message: Request | ReadSegment | FindKeyframe) -> tuple[Child, str]:
        """Sends a request that no client asked for.

        Returns the child and the token of the expected answer.
        """
        child = self.holder(kind) if isinstance(message, child_messages.WorldCommand) else None
        child, token = child or self.ensure(kind), self._token()
        child.expect(token)
        self.ask(kind, message, token)
        return child, token

    def interrupt(self, child: Child) -> None:
        """Interrupts the child's current tick."""
        self._effect(Interrupt(child.kind, child.number))

    def drop(self, kind: Kind, *, grace_s: float = 0.0, reason: str = "was ended") -> None:
        """Drops the child of a kind and ends it.

        After a grace period, in which it may end by itself, it is killed.
        """
        child = self.living.pop(kind, None)
        if child is None:
            return
        child.end(reason)  # steps that wait for this child fail now
        self._lost(child, reason)
        self.leaving.add((kind, child.number))
        if grace_s:
            self._effect(Tell(kind, child.number, child_messages.Stop()))
            self._effect(Retire(kind, child.number, grace_s))
        else:
            self._effect(Kill(kind, child.number))

    def _tell(self, kind: Kind, message: Told) -> None:
        host = self.host
        if kind == "world" and host is not None and isinstance(message, child_messages.WorldCommand):
            self._effect(Tell(host.kind, host.number, child_messages.ForWorld(message)))
        elif kind in self.living:
            self._effect(Tell(kind, self.living[kind].number, message))
