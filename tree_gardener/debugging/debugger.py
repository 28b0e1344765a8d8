"""The debugger: decides at each node that asks whether the tree is held, and forces results."""

from collections.abc import Callable, Sequence

from tree_gardener.controls.ordered import Ordered
from tree_gardener.debugging.ahead import ahead
from tree_gardener.debugging.breakpoints import Breakpoint, Breakpoints
from tree_gardener.debugging.forces import Force, ForceError, Forces
from tree_gardener.debugging.stepper import Event, Shape, Step, Stepper
from tree_gardener.debugging.stop import Stop
from tree_gardener.debugging.wiring import NOTHING, Wanted, Wiring
from tree_gardener.node import Node
from tree_gardener.status import RUNNING, Status

Hold = Callable[[Stop], None]


class Debugger:
    """An agent for `Tree.debug`.

    Its commands are for the ticking thread, while the tree is held or between two ticks; `request_hold`
    may also be called by a signal handler. What is set takes effect at once, also in the tick in progress.

    Args:
        hold: called at a stop, on the ticking thread; the tree is held until it returns. It chooses how
            to continue with `resume`, and may raise `DebuggingEnded` to end the run there.
        say: called with the line of a breakpoint that logs.

    Attributes:
        held: the stop at which the tree is held, or None.
        breakpoints: the breakpoints; change them by `set_breakpoints`.
        alone: the uid of the node that runs alone; 0 for none.
    """

    breakpoints: Breakpoints
    _wiring: Wiring
    _shape: Shape
    _stepper: Stepper
    _forces: Forces

    def __init__(self, hold: Hold, say: Callable[[str], None] = print) -> None:
        self.held: Stop | None = None
        self.alone = 0
        self._hold = hold
        self._say = say

    def request_hold(self) -> None:
        """Stops the tree at the next node that is ticked.

        The nodes of a generated function that runs at this moment do not ask; then it is the next one after
        that, at the latest the root in the next tick.
        """
        self._stepper.hold()
        self._wiring.choose(self._wanted(), everything=True)

    def resume(self, step: Step = Step.CONTINUE, target: int = 0) -> None:
        """Chooses how the tree continues: when `hold` returns, or from the next tick on.

        Args:
            step: the step; breakpoints stop the tree also within it.
            target: the uid of the node for TO.
        """
        stop = self.held
        event, uid = (None, 0) if stop is None else (stop.event, stop.uid)
        self._stepper.begin(step, event, uid, self._tree.tick_number, target)
        self._refresh()

    def set_breakpoints(self, breakpoints: Sequence[Breakpoint]) -> None:
        """Replaces all breakpoints.

        Raises:
            BreakpointError: one is wrong; all are as they were.
        """
        self.breakpoints.set(breakpoints)
        self._refresh()

    def turn_breakpoints(self, *, on: bool) -> None:
        """Switches all breakpoints on or off, without a change to them."""
        self.breakpoints.are_on = on
        self._refresh()

    def force(self, force: Force) -> None:
        """Forces a result on a node, in place of what was forced on it before.

        Raises:
            ForceError: there is no such result.
        """
        self._forces.set(force)
        self._refresh()

    def skip_to(self, uid: int) -> None:
        """Skips the siblings before a node that are not ticked yet, once.

        Raises:
            ForceError: the node's parent does not pass over skipped children, or is past the node.
        """
        node = self._tree.nodes[uid - 1]
        self._forces.skip_to(node, self._reached(node))
        self._refresh()

    def run_alone(self, uid: int) -> None:
        """Ticks a node in place of the root, from the next tick on; all else is halted before.

        Raises:
            ForceError: it is the root.
        """
        if uid == 1:
            raise ForceError("the root runs alone as it is")
        self.alone = uid
        self._wiring.tick_alone(self._tree.nodes[uid - 1])

    def release(self, uid: int | None = None) -> bool:
        """Ends what is forced on a node, or on all (None); returns whether there was anything."""
        released = False
        for each in [force.uid for force in self._forces.all] if uid is None else [uid]:
            released |= self._forces.release(each)
        if self.alone and uid in (None, self.alone):
            self.alone = 0
            self._wiring.tick_alone(None)
            released = True
        self._refresh()
        return released

    @property
    def forces(self) -> list[Force]:
        """The results that are forced now, in the order of the nodes."""
        return self._forces.all

    def attach(self, wiring: Wiring) -> None:
        """Is called by `Tree.debug`."""
        self._wiring = wiring
        self._tree = wiring.tree
        self._shape = Shape.of(self._tree.nodes)
        self._stepper = Stepper(self._shape)
        self._forces = Forces(self._tree.nodes)
        self.breakpoints = Breakpoints(self._tree.nodes, self._say, wiring.watch_writes)

    def before(self, node: Node) -> None:
        """Is asked before the tick of a node."""
        self._forces.forget_skips(node, is_reached=True)
        self._ask(Event.BEFORE, node, None, "")

    def after(self, node: Node, status: Status, decided: str) -> Status:
        """Is asked after the tick of a node; returns its result."""
        result = self._result(node, status, decided)
        if self._forces.has_ended:
            self._forces.has_ended = False
            self._refresh()
        return result

    def _result(self, node: Node, status: Status, decided: str) -> Status:
        self._forces.forget_skips(node, is_reached=False)
        replaced = self._forces.after(node, status)
        result = status if replaced is None else replaced
        if self._ask(Event.DECIDED if decided else Event.AFTER, node, result, decided) and replaced is None:
            forced_meanwhile = self._forces.after(node, result)
            return result if forced_meanwhile is None else forced_meanwhile
        return result

    def forced(self, node: Node) -> Status | None:
        """Returns the result that is forced in place of a node's tick, or None."""
        return self._forces.before(node)

    def may_halt(self, node: Node) -> bool:
        """Returns whether a node can be halted."""
        return self._forces.may_halt(node)

    def halted(self, node: Node) -> None:
        """Is called when a node was halted."""
        self._forces.halted(node)
        if self._tree.is_ticking:
            self._ask(Event.HALTED, node, None, "")

    def _ask(self, event: Event, node: Node, status: Status | None, decided: str) -> bool:
        """Holds the tree at an event if a breakpoint or a step says so; returns whether it did."""
        if self.held is not None:
            return False  # a command halts a node
        why = self.breakpoints.reason(event, node, status)
        why = why or self._stepper.reason(event, node.uid, self._tree.tick_number)
        if not why:
            return False
        self._stepper.end()
        lead = lead_to(node)
        rest = ahead(self._tree.nodes, self._shape, node.uid, event)
        stop = Stop(event, node.uid, node.path, self._tree.tick_number, status, decided, why, lead, rest)
        self.held = stop
        self._wiring.choose(self._wanted(), everything=True)
        try:
            self._hold(stop)
        finally:
            self.held = None
            self._refresh()
        return True

    def _refresh(self) -> None:
        is_all = self.held is not None or self._stepper.is_stepping
        self._wiring.choose(self._wanted(), everything=is_all)

    def _wanted(self) -> dict[int, Wanted]:
        wanted = self.breakpoints.wanted()
        for uid, more in self._forces.wanted().items():
            wanted[uid] = wanted.get(uid, NOTHING).joined(more)
        return wanted

    def _reached(self, node: Node) -> int:
        """Returns the position of the sibling that the node's parent ticks now, or next."""
        parent = node.parent
        if parent is None:
            return 0
        if self.held is not None:
            on_path = [index for index, child in enumerate(parent.children) if child.uid in self.held.lead]
            if on_path:
                is_done = (
                    self.held.uid == parent.children[on_path[0]].uid and self.held.event is not Event.BEFORE
                )
                return min(on_path[0] + is_done, len(parent.children) - 1)
        is_resumed = isinstance(parent, Ordered) and parent.status is RUNNING
        return parent.index if is_resumed and isinstance(parent, Ordered) else 0


def lead_to(node: Node) -> tuple[int, ...]:
    """Returns the uids from the root to a node."""
    lead = [node.uid]
    above = node.parent
    while above is not None:
        lead.append(above.uid)
        above = above.parent
    return tuple(reversed(lead))
