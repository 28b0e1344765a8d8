"""Results that users force on nodes, for one tick or until they are released."""

import dataclasses
import enum
from collections.abc import Sequence
from typing import Final

from tree_gardener.controls.ordered import Ordered
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence
from tree_gardener.debugging.wiring import NOTHING, RESULTS, Wanted
from tree_gardener.node import Node
from tree_gardener.status import IDLE, RUNNING, SKIPPED, Status

PASSING: Final = (Ordered, ReactiveSequence, ReactiveFallback)
"""Sequences and fallbacks: they pass over a skipped child."""


class Position(enum.Enum):
    """Whether a result is forced in place of the tick, or replaces the result of the tick."""

    BEFORE = "before"
    AFTER = "after"


@dataclasses.dataclass(frozen=True)
class Force:
    """A forced result.

    Attributes:
        uid: the node.
        status: SUCCESS, FAILURE or SKIPPED; RUNNING freezes the node.
        once: whether it holds for one tick, or until it is released.
        position: in place of the tick or after it.
        skips_to: the uid of the sibling that is to be reached, if it was forced for that; else 0.
    """

    uid: int
    status: Status
    once: bool = False
    position: Position = Position.BEFORE
    skips_to: int = 0


class ForceError(ValueError):
    """A result cannot be forced; the text says why."""


class Forces:
    """The forced results of a tree, at most one for each node.

    In place of a tick: the node's pre-conditions are tested as always, and their decision wins. Then a
    RUNNING node is halted with its children, and has the result; its post-conditions run. After a tick: the
    result of the node is replaced; its own post-conditions have seen the first one.

    A frozen node is RUNNING and is not ticked. If it had not begun, nothing of it is called: not by a halt
    either, and when it is released it is IDLE, so that its next tick begins it.

    Attributes:
        has_ended: whether a result was released, or forced for the one time; its reader sets it back.
    """

    def __init__(self, nodes: Sequence[Node]) -> None:
        self._nodes = nodes
        self._at: dict[int, Force] = {}
        self.has_ended = False
        self._begun: dict[int, bool] = {}  # of the frozen nodes that were reached

    @property
    def all(self) -> list[Force]:
        """The forced results, in the order of the nodes."""
        return [self._at[uid] for uid in sorted(self._at)]

    def set(self, force: Force) -> None:
        """Forces a result.

        Raises:
            ForceError: there is no such result.
        """
        if force.status is IDLE:
            raise ForceError(
                "IDLE is not a result of a tick: force SUCCESS, FAILURE or SKIPPED, or freeze the node"
            )
        if force.status is RUNNING and (force.once or force.position is Position.AFTER):
            raise ForceError("a node is frozen as RUNNING in place of its ticks, until it is released")
        self.release(force.uid)
        self._at[force.uid] = force

    def release(self, uid: int) -> bool:
        """Ends what is forced on a node; returns whether there was anything."""
        force = self._at.pop(uid, None)
        self.has_ended |= force is not None
        if force is not None and self._begun.pop(uid, True) is False:
            self._make_idle(self._nodes[uid - 1])
        return force is not None

    def skip_to(self, node: Node, reached: int) -> None:
        """Forces SKIPPED, once, on the siblings before a node that its parent has not ticked yet.

        Args:
            node: the node to be reached.
            reached: the position of the child that the parent ticks now, or at its next tick.

        Raises:
            ForceError: the parent does not pass over skipped children, or is past the node.
        """
        parent = node.parent
        if parent is None:
            raise ForceError("the root has no siblings to skip")
        if not isinstance(parent, PASSING):
            raise ForceError(
                f"{parent.type} does not pass over skipped children: this works below sequences and fallbacks"
            )
        position = parent.children.index(node)
        if position < reached:
            now = parent.children[reached].local_path
            raise ForceError(f"'{parent.local_path}' is past this node: it has reached '{now}'")
        for sibling in parent.children[reached:position]:
            self.set(Force(sibling.uid, SKIPPED, once=True, skips_to=node.uid))

    def wanted(self) -> dict[int, Wanted]:
        """Returns what must be asked at which nodes."""
        wanted: dict[int, Wanted] = {}

        def add(uid: int, more: Wanted) -> None:
            wanted[uid] = wanted.get(uid, NOTHING).joined(more)

        for force in self._at.values():
            is_asked = force.once or force.position is Position.AFTER
            results = RESULTS if is_asked else NOTHING.results
            add(force.uid, Wanted(results=results, within=True))
            if force.skips_to:
                parent = self._nodes[force.uid - 1].parent
                assert parent is not None
                add(force.skips_to, Wanted(before=True))
                add(parent.uid, Wanted(results=RESULTS))
        return wanted

    def before(self, node: Node) -> Status | None:
        """Returns the result in place of a node's tick, or None; a RUNNING node is halted before."""
        force = self._at.get(node.uid)
        if force is None or force.position is not Position.BEFORE:
            return None
        _note(node)
        if force.status is RUNNING:
            is_running = node.status is RUNNING
            self._begun[node.uid] = is_running and self._begun.get(node.uid, True)
            return RUNNING
        if force.once:
            self.release(node.uid)
        if node.status is RUNNING:
            node.stop()
        return force.status

    def after(self, node: Node, status: Status) -> Status | None:
        """Returns the result that replaces that of a node's tick, or None, and sets the node's status."""
        force = self._at.get(node.uid)
        if force is None or force.position is not Position.AFTER:
            return None
        _note(node)
        if force.once:
            self.release(node.uid)
        if force.status is not status:
            if node.status is RUNNING:
                node.stop()
            if force.status is SKIPPED:
                self._make_idle(node)
                node.skipped()
            else:
                node.complete(force.status)
        return force.status

    def may_halt(self, node: Node) -> bool:
        """Returns whether a node can be halted; a frozen one that had not begun cannot."""
        return self._begun.get(node.uid, True)

    def halted(self, node: Node) -> None:
        """Notes that a node was halted: one that is frozen has to begin again."""
        if node.uid in self._begun:
            self._begun[node.uid] = False

    def forget_skips(self, node: Node, *, is_reached: bool) -> None:
        """Releases the skips that lead to a node that is reached, or whose parent has returned."""
        for force in self.all:
            if force.skips_to and (
                force.skips_to == node.uid if is_reached else self._nodes[force.uid - 1].parent is node
            ):
                self.release(force.uid)

    def _make_idle(self, node: Node) -> None:
        if node.status is IDLE:
            return
        node.status = IDLE
        if node.journal is not None:
            node.journal.touched.append(node)


def _note(node: Node) -> None:
    """Notes, while the tree is observed, that the node's result in this tick is a forced one."""
    if node.journal is not None and node.uid not in node.journal.forced:
        node.journal.forced.append(node.uid)
