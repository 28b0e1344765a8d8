"""Runs control nodes and decorators that users write: calls `update`, and handles its result.

After `update`, SUCCESS and FAILURE set the node's status. A control node resets no children by itself; the
child of a decorator becomes IDLE if it is done. SKIPPED does not change the node's status. Violations of the
contract are TickErrors with a code:

* TG701: the child does not exist;
* TG702: `update` returned a value that is not a result of a tick;
* TG703: a child was ticked or halted outside of the node's own tick, or ticked after the node was halted;
* TG704: a child was ticked or halted from another thread;
* TG705: the node, or one of its children, was ticked while it was being ticked.
"""

from collections.abc import Callable, Mapping
from threading import get_ident
from typing import Any

from py_trees.common import Status as PyTreesStatus

from tree_gardener.clock import Timer
from tree_gardener.control_node import ControlNode
from tree_gardener.errors import TickError, calling_place, class_place, describe, warn_of
from tree_gardener.node import Control, Kind, Node
from tree_gardener.ports import Manifest
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

_RESULTS = {
    **{status: status for status in (SUCCESS, FAILURE, RUNNING, SKIPPED)},
    PyTreesStatus.SUCCESS: SUCCESS,
    PyTreesStatus.FAILURE: FAILURE,
    PyTreesStatus.RUNNING: RUNNING,
}
_FROM_UPDATE = "call it only from update(), while the node is being ticked"
_FROM_OWN_CALLS = "call it only from update(), halt() or a timer of start_timer()"


class CustomControl(Control):
    """A control node whose rule is a class of the user.

    Attributes:
        instance_behaviour: the user's object.
        owner: the same, or the adapter around a composite or decorator of py_trees.
        thread: the id of the thread that runs the user's code now, or 0.
        is_ticking: whether that code is `update`.
        is_in_child: whether a child is being ticked.
        was_halted: whether the node was halted from outside within its tick.
    """

    __slots__ = (
        *("instance_behaviour", "is_in_child", "is_ticking", "marks_running", "own_halt", "owner"),
        *("thread", "update", "was_halted"),
    )

    def __init__(self, kind: str, name: str, manifest: Manifest | None, ports: Mapping[str, str]) -> None:
        super().__init__(kind, name, manifest, ports)
        self.instance_behaviour: Any = None
        self.owner: Any = None
        self.thread = 0
        self.is_ticking = self.is_in_child = self.was_halted = False

    def bind(self, behaviour: ControlNode) -> None:
        """Sets the user's object."""
        self.owner = behaviour
        self.instance_behaviour = getattr(behaviour, "adapted", behaviour)
        self.update: Callable[[], Any] = behaviour.update
        self.marks_running = bool(behaviour.MARKS_RUNNING)
        is_own = type(behaviour).halt is not ControlNode.halt
        self.own_halt: Callable[[], Any] | None = behaviour.halt if is_own else None

    def replace_update(self, update: Callable[[], Any]) -> None:
        """Calls another function in place of `update` from the next tick on."""
        self.update = update

    def execute(self) -> Status:
        return self.settle(self.run())

    def execute_guarded(self) -> Status:
        guard = self.guard
        if guard is None:  # a debugger may still give it one
            return self.execute()
        status = guard.before(self)
        if status is None:
            status = self.run()
        if status is SUCCESS or status is FAILURE:
            guard.after(self, status)
        return self.settle(status)

    def run(self) -> Status:
        """Runs `update`, and returns its result after a check that it is a valid one."""
        if self.thread:
            hint = "do not tick the tree from its own nodes"
            raise self.fault("TG705", f"{self.type} is ticked while its own code runs", hint)
        if self.marks_running and self.status is not RUNNING:
            self.start()
        self.thread = get_ident()
        self.is_ticking = True
        self.was_halted = False
        try:
            return self.result_of(self.update())
        except TickError as error:
            if error.uid != self.uid:
                raise  # the error names a node below this one
            return self.failed(error)
        except (Exception, SystemExit) as error:
            return self.failed(TickError(self, describe(error), error))
        finally:
            self.thread = 0
            self.is_ticking = False

    def result_of(self, returned: Any) -> Status:
        """Converts the value that `update` returned to a status."""
        try:
            status = _RESULTS.get(returned)
        except TypeError:  # not hashable
            status = None
        if status is None:
            what = "nothing" if returned is None else repr(returned)
            raise TickError(
                *(self, f"{self.type}.update() returned {what}, which is no result of a tick"),
                code="TG702",
                hint="return Status.SUCCESS, FAILURE, RUNNING or SKIPPED",
                place=class_place(self),
            )
        if status is SUCCESS or status is FAILURE:
            for child in self.children:
                if child.status is RUNNING:
                    self.warn_of(status, child)
        return status

    def warn_of(self, status: Status, child: Node) -> None:
        """Warns once if the node is done before its child is done."""
        sentence = f"{self.type} returned {status.name} while its child '{child.local_path}' is RUNNING"
        self.tree.warn(self, f"{sentence}: halt it, or it continues unseen")

    def settle(self, status: Status) -> Status:
        """Sets the node's status to a result, and returns the result."""
        if status is RUNNING:
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        return self.skipped() if status is SKIPPED else self.complete(status)

    def failed(self, error: TickError) -> Status:
        """Handles a fault of the user's code.

        The tick ends with the error, or the node fails, as configured.
        """
        if self.tree.on_error is None:
            raise error from error.cause
        self.tree.on_error(error)
        self.reset_children()
        return FAILURE

    def halt(self) -> None:
        """Runs the user's `halt`, then halts the children and makes the node IDLE.

        An exception in the user's `halt` is reported and changes nothing.
        """
        self.was_halted = self.is_ticking
        if self.own_halt is not None:
            try:
                self.call(self.own_halt)
            except TickError as error:
                warn_of(self, "halt", error.cause or error)
        self.reset_children()
        self.status = IDLE

    def halt_by_itself(self) -> None:
        """Halts the children and makes the node IDLE, at the request of the node's own code."""
        self.require_own_call("halts itself")
        self.reset_children()
        self.status = IDLE
        if self.journal is not None:
            self.journal.touched.append(self)

    def call(self, function: Callable[[], Any]) -> None:
        """Calls the user's code outside of `update`; this code may halt children, but not tick them."""
        before = self.thread, self.is_ticking, self.is_in_child
        self.thread, self.is_ticking, self.is_in_child = get_ident(), False, False
        try:
            function()
        except TickError:
            raise
        except (Exception, SystemExit) as error:
            raise TickError(self, describe(error), error) from error
        finally:
            self.thread, self.is_ticking, self.is_in_child = before

    def start_timer(self, delay_s: float, callback: Callable[[], None]) -> Timer:
        """Starts a timer of the tree that calls the user's code."""
        from tree_gardener.callbacks import Owned  # noqa: PLC0415 - it handles nodes of this class

        owner = self.owner  # it may have moved to another node when the time is over
        guarded = Owned(callback, self.instance_behaviour)
        return self.tree.timers.start(delay_s, lambda: owner.tree_gardener_node.call(guarded), owner)

    def child_at(self, index: int) -> Node:
        """Returns the child with this index."""
        if type(index) is not int or not 0 <= index < len(self.children):
            raise self.no_such_child(index)
        return self.children[index]

    def mark_running(self) -> None:
        """Makes the node RUNNING within its tick."""
        if self.thread != get_ident() or not self.is_ticking:
            raise self.misplaced("marks itself RUNNING", _FROM_UPDATE)
        if self.status is not RUNNING:
            self.start()

    def tick_child(self, index: int) -> Status:
        """Ticks a child and returns its result."""
        if self.thread != get_ident() or not self.is_ticking or self.is_in_child or self.was_halted:
            raise self.misplaced("ticks a child", _FROM_UPDATE)
        if type(index) is not int or not 0 <= index < len(self.ticks):
            raise self.no_such_child(index)
        self.is_in_child = True
        try:
            return self.ticks[index]()
        finally:
            self.is_in_child = False

    def halt_child(self, index: int) -> None:
        """Halts a child if it is RUNNING, and makes it IDLE."""
        self.require_own_call("halts a child")
        self.child_at(index)
        self.reset_child(index)

    def halt_children(self, first: int) -> None:
        """Halts the children from `first` on."""
        self.require_own_call("halts its children")
        count = len(self.children)
        if type(first) is not int or not 0 <= first <= count:
            raise self.no_such_child(first)
        for index in range(first, count):
            self.reset_child(index)

    def require_own_call(self, what: str) -> None:
        """Raises a TickError unless the node's own code makes the call while no child is being ticked."""
        if self.thread != get_ident() or self.is_in_child:
            raise self.misplaced(what, _FROM_OWN_CALLS)

    def misplaced(self, what: str, hint: str) -> TickError:
        """Returns the fault of a call at the wrong time or from the wrong thread."""
        if self.thread and self.thread != get_ident():
            return self.fault("TG704", f"{self.type} {what} from another thread", hint)
        if self.is_in_child:
            hint = "wait until tick_child() has returned"
            return self.fault("TG705", f"{self.type} {what} while a child is being ticked", hint)
        if self.is_ticking and self.was_halted:
            hint = "return from update(): the tree was halted by the child that was ticked"
            return self.fault("TG703", f"{self.type} {what} after it was halted", hint)
        return self.fault("TG703", f"{self.type} {what} outside of its own tick", hint)

    def no_such_child(self, index: object) -> TickError:
        """Returns the fault of an invalid index of a child."""
        count = len(self.children)
        known = "its only child is 0" if count == 1 else f"its children are 0 to {count - 1}"
        return self.fault("TG701", f"{self.type} has no child {index!r}", known)

    def fault(self, code: str, message: str, hint: str) -> TickError:
        """Returns a fault of the user's code, with the line that called the engine."""
        return TickError(self, message, code=code, hint=hint, place=calling_place())


class CustomDecorator(CustomControl):
    """A decorator whose rule is a class of the user."""

    __slots__ = ()
    KIND = Kind.DECORATOR

    def settle(self, status: Status) -> Status:
        """Sets the status to a result; a child that is done becomes IDLE."""
        super().settle(status)
        child = self.children[0].status
        if child is SUCCESS or child is FAILURE:
            self.reset_child(0)
        return status
