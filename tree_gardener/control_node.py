"""Base classes for users' control nodes and decorators.

```python
from tree_gardener import ControlNode, Status


class FirstToSucceed(ControlNode):
    MARKS_RUNNING = True

    def update(self):
        for index in range(self.child_count):
            if self.tick_child(index) is Status.SUCCESS:
                self.halt_children()
                return Status.SUCCESS
        return Status.RUNNING
```

The engine evaluates the pre- and post-conditions of the node before and after `update`. The module
`tree_gardener.controls.custom` describes how the engine handles the result.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from tree_gardener.ports import read_port, write_port
from tree_gardener.status import Status

if TYPE_CHECKING:
    from tree_gardener.clock import Timer
    from tree_gardener.controls.custom import CustomControl


class ControlNode:
    """The base class of a user's control node, whose `update` decides which children are ticked.

    Declare ports with ``INPUT_PORTS``, ``OUTPUT_PORTS`` and ``INOUT_PORTS``, as in an action. The constructor
    is called with the node's name; children, ports and the clock are available from `setup` on.

    Attributes:
        NODE_KIND: the kind of the node; the checker needs it if the base class is in another file.
        MARKS_RUNNING: whether the engine makes the node RUNNING before `update`, as the nodes of
            BehaviorTree.CPP do that call ``setStatus(RUNNING)`` first.
        MIN_CHILDREN: the smallest number of children, 1 or more; checked when the tree is loaded.
        MAX_CHILDREN: the largest number of children, or None for any number.
        name: the node's name.
    """

    NODE_KIND: ClassVar[str] = "Control"
    MARKS_RUNNING: ClassVar[bool] = False
    MIN_CHILDREN: ClassVar[int] = 1
    MAX_CHILDREN: ClassVar[int | None] = None

    tree_gardener_node: "CustomControl"

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return f"<{type(self).__name__} '{self.name}'>"

    def setup(self, **kwargs: Any) -> None:
        """Prepares the node once, before the first tick; ``kwargs["node"]`` is the rclpy node or None."""

    def update(self) -> Status:
        """Executes one tick, and returns the result.

        SUCCESS, FAILURE and RUNNING become the node's status; children keep their status until you reset
        them. SKIPPED does not change the node's status. Any other value, including None, is a TickError.
        """
        # Abstract. The text names the class, since users write it, and this becomes a fault of their node.
        raise NotImplementedError(f"{type(self).__name__} has no method update")

    def halt(self) -> None:
        """Stops the node: halts its children and makes it IDLE.

        Override it to reset the state of your class. The engine calls the override first, and then halts the
        children itself, even after an exception; so the override need not call this method. The method may be
        called while the node is IDLE. Call ``self.halt()`` in `update` to restart the node.
        """
        self._node.halt_by_itself()

    def shutdown(self) -> None:
        """Frees the resources that `setup` acquired; called once, at the end."""

    @property
    def _node(self) -> "CustomControl":
        node: CustomControl | None = getattr(self, "tree_gardener_node", None)
        if node is None:
            raise RuntimeError(
                f"{self!r} is in no tree yet: children, ports and clock are there from setup() on"
            )
        return node

    @property
    def status(self) -> Status:
        """The node's own status; during `update`, the status from before the tick, or RUNNING."""
        return self._node.status

    @property
    def child_count(self) -> int:
        """The number of children."""
        return len(self._node.children)

    def child_status(self, index: int) -> Status:
        """Returns the stored status of a child; never SKIPPED.

        Raises:
            TickError: the child does not exist.
        """
        return self._node.child_at(index).status

    def mark_running(self) -> None:
        """Makes the node RUNNING within its tick, for a node that tests something before that.

        Raises:
            TickError: it is called outside of the node's own tick.
        """
        self._node.mark_running()

    def tick_child(self, index: int) -> Status:
        """Ticks a child and returns its result, which may be SKIPPED: the child then keeps its status.

        The same child may be ticked again in one tick. A StatefulAction that has kept SUCCESS or FAILURE
        returns it again without a callback; reset the child first to start it again.

        Raises:
            TickError: the child or a node below it raised an exception (the error names that node), the child
                does not exist, or the call comes from outside of the node's own tick, from another thread, or
                while a child is being ticked.
        """
        return self._node.tick_child(index)

    def halt_child(self, index: int) -> None:
        """Halts a child if it is RUNNING (its ``_onHalted`` runs), and makes it IDLE in every case.

        Raises:
            TickError: the child raised an exception, or for any other reason of `tick_child`. Unlike
                `tick_child`, this method may also be called by `halt` and by timers.
        """
        self._node.halt_child(index)

    def halt_children(self, first: int = 0) -> None:
        """Halts the children from `first` on, in order."""
        self._node.halt_children(first)

    def reset_children(self) -> None:
        """Halts all children that are RUNNING, and makes all of them IDLE."""
        self._node.halt_children(0)

    def emit_wake_up(self) -> None:
        """Requests another tick soon; may be called from any thread."""
        self._node.tree.wake()

    def now(self) -> float:
        """Returns seconds of the tree's clock: simulated time if there is one. Use no other clock."""
        return self._node.tree.clock.now()

    def start_timer(self, delay_s: float, callback: Callable[[], None]) -> "Timer":
        """Calls `callback` at the first tick, or in the first sleep between ticks, after `delay_s` seconds.

        The callback may halt children and wake the tree up, but cannot tick a child. Cancel the timer in
        `halt` with its method ``cancel()``.
        """
        return self._node.start_timer(delay_s, callback)

    def get_input(self, port: str) -> Any:
        """Reads an input port, converted to its type.

        Raises:
            PortError: the port has no value, or its value cannot be converted.
        """
        return read_port(self._node, port)

    def set_output(self, port: str, value: Any) -> None:
        """Writes an output port.

        Raises:
            PortError: the tree gives the port no ``{key}``, or the entry has another type.
        """
        write_port(self._node, port, value)


class DecoratorNode(ControlNode):
    """The base class of a user's decorator, a node with exactly one child.

    After each tick of the decorator, a child in SUCCESS or FAILURE becomes IDLE.
    """

    NODE_KIND: ClassVar[str] = "Decorator"
    MAX_CHILDREN: ClassVar[int | None] = 1

    def child_status(self, index: int = 0) -> Status:
        """Returns the stored status of the child; never SKIPPED."""
        return super().child_status(index)

    def tick_child(self, index: int = 0) -> Status:
        """Ticks the child and returns its result, which may be SKIPPED."""
        return super().tick_child(index)

    def halt_child(self, index: int = 0) -> None:
        """Halts the child if it is RUNNING, and makes it IDLE in every case."""
        super().halt_child(index)


class LoopNode:
    """The base class of a loop over elements of any type, as BehaviorTree.CPP's ``LoopNode<T>``.

    ```python
    class LoopPose(LoopNode):
        ELEMENT = Pose
    ```

    It follows the rule of the built-in Loop nodes: it ticks its child once for each element of `queue`, and
    writes the element to `value`. A SharedQueue on the blackboard is consumed in place, a list or tuple is
    copied.

    Attributes:
        ELEMENT: the type of an element; Any accepts everything. Only int, float, str, bool and enums can be
            written as text in `queue`.
    """

    NODE_KIND: ClassVar[str] = "Decorator"
    ELEMENT: ClassVar[Any] = Any
