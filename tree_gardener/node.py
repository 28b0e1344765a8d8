"""The nodes of a running tree: what all of them share.

A node's `execute` is its whole tick: it applies the node's rule, sets the node's own status and returns the
result. Parents call the `entry` of their children directly, through tuples that are made once (`link`). So a
plain node costs one call; only nodes with conditions or hooks cost more.

While the tree is observed, `journal` is the recorder. A node reports to it when it starts (`touched`), and
reports its results, each as one of its `marks`, which are made once (`results`). The code that resets a node
reports the reset if the status changes. Without observers, `journal` is None, and this test is the only cost.
"""

import enum
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Final, TypeVar

from tree_gardener.errors import PortError, TickError
from tree_gardener.ports import BoundPorts, Manifest, read_port, write_port
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.blackboard import Blackboard
    from tree_gardener.conditions import Guard
    from tree_gardener.document import Element
    from tree_gardener.observe import Recorder
    from tree_gardener.tree import Tree

T = TypeVar("T")
Execute = Callable[[], Status]
Flash = tuple[int, Status]
Mark = tuple["Node", tuple[Flash, ...]]
"""A report of results of a node and of nodes below it, all of which are IDLE if it is IDLE."""
Marks = tuple[Mark, Mark, Mark]
NO_PORTS: Final[Mapping[str, str]] = {}
NO_TICKS: Final[list[Execute]] = []
"""The ticks of nodes without children; never filled."""
NO_INPUTS: Final[dict[str, Any]] = {}
"""The inputs of nodes that have read none; never filled."""


class Kind(enum.Enum):
    """The kinds of nodes."""

    CONTROL = "Control"
    DECORATOR = "Decorator"
    ACTION = "Action"
    CONDITION = "Condition"
    SUBTREE = "SubTree"


class Instance:
    """One instantiation of a BehaviorTree: the main tree, or the body of one SubTree node."""

    __slots__ = ("board", "subtree", "tree_id")

    def __init__(self, tree_id: str, board: "Blackboard", subtree: "Node | None") -> None:
        self.tree_id = tree_id
        self.board = board
        self.subtree = subtree

    def above(self) -> "set[str]":
        """Returns the IDs of this tree and of the trees around it."""
        found = {self.tree_id}
        node = self.subtree
        while node is not None:
            found.add(node.instance.tree_id)
            node = node.instance.subtree
        return found

    def path(self) -> str:
        """Returns the path of the scope: that of the SubTree node, or "" for the main tree."""
        parts = []
        node = self.subtree
        while node is not None:
            parts.append(node.scope_path)
            node = node.instance.subtree
        return "/".join(reversed(parts))


class _Statuses:
    """The statuses of a node, in front of all else: one line of the processor's cache holds them."""

    __slots__ = ("reported", "status")


class Node(_Statuses):
    """The base of all nodes.

    Attributes:
        tree: the tree of which the node is a part.
        uid: 1 for the root, then in pre-order.
        type: the tag of the node in XML.
        name: the name of the node, or its type if it has none.
        parent: the parent; None for the root.
        children: the children in order of execution.
        status: the stored status; never SKIPPED.
        board: the scope of the blackboard that its ports and scripts use.
        ports: the texts that the document gives its ports.
        bound: the ports that an action's constructor received; None for others.
        early: the ports that an action read before the first tick.
    """

    __slots__ = (
        *(
            "board",
            "bound",
            "children",
            "early",
            "element",
            "guard",
            "inputs",
            "instance",
            "journal",
            "manifest",
            "marks",
        ),
        *("name", "parent", "ports", "ticks", "tree", "type", "uid", "view"),
    )

    KIND: ClassVar[Kind]
    RULE: ClassVar[str] = ""
    MARKS_RUNNING: ClassVar[tuple[Status, ...]] = (IDLE, SUCCESS, FAILURE)
    """The statuses from which the node makes itself RUNNING before it ticks its children."""
    NEEDS: ClassVar[str] = ""
    """The port without which the node cannot be created; BehaviorTree.CPP reads it in the constructor."""
    CODE: ClassVar[str] = ""
    """The port that holds a script, which is read when the node is made."""
    READ_AT_LOAD: ClassVar[str] = ""
    """The port that is read when the tree is built, and never again."""

    tree: "Tree"

    def __init__(self, kind: str, name: str, manifest: Manifest | None, ports: Mapping[str, str]) -> None:
        self.type = kind
        self.name = name
        self.manifest = manifest
        self.ports = ports
        self.inputs = NO_INPUTS
        self.bound: BoundPorts | None = None
        self.early: frozenset[str] = frozenset()
        self.uid = 0
        self.parent: Node | None = None
        self.children: tuple[Node, ...] = ()
        self.ticks: list[Execute] = NO_TICKS
        self.status = IDLE
        self.guard: Guard | None = None
        self.journal: Recorder | None = None
        self.reported = IDLE
        self.marks: Marks
        self.view: Any = None
        self.board: Blackboard
        self.instance: Instance
        self.element: Element

    @property
    def number(self) -> int:
        """The number of the node in BehaviorTree.CPP, which also counts the nodes below replaced ones."""
        return self.tree.numbers.get(self.uid, self.uid)

    @property
    def local_path(self) -> str:
        """The last part of the path: the name, or ``Type::number`` if it has none, or that of its type."""
        kind = self.element.type_id
        return f"{kind}::{self.number}" if self.name == kind else self.name

    @property
    def scope_path(self) -> str:
        """The last part of the path of a SubTree's nodes; other nodes have none."""
        return self.local_path

    @property
    def path(self) -> str:
        """The names of the SubTrees that contain the node, and its own name, joined by ``/``."""
        prefix = self.instance.path()
        return f"{prefix}/{self.local_path}" if prefix else self.local_path

    @property
    def node_id(self) -> str:
        """The id of the diagram's node from which it was made, or ""."""
        return self.element.attributes.get("_bts_id", "")

    @property
    def tree_id(self) -> str:
        """The ID of the BehaviorTree of which it is a part."""
        return self.instance.tree_id

    @property
    def kind(self) -> str:
        """``Control``, ``Decorator``, ``Action``, ``Condition`` or ``SubTree``."""
        return self.KIND.value

    @property
    def attributes(self) -> Mapping[str, str]:
        """All attributes of the node in XML."""
        return self.element.attributes

    @property
    def behaviour(self) -> Any:
        """The py_trees object of the node: the user's behaviour for an action, a view for other nodes."""
        from tree_gardener.views import view_of  # noqa: PLC0415 - views need nodes

        return view_of(self)

    def __repr__(self) -> str:
        return f"<{self.type} '{self.path}' {self.status.name}>"

    # The next two are abstract: each family of nodes has its own.

    def execute(self) -> Status:
        """Ticks the node: applies its rule, sets its status, returns the result."""
        raise NotImplementedError

    def halt(self) -> None:
        """Stops the node and all below it; its status is IDLE afterwards."""
        raise NotImplementedError

    def entry(self) -> Execute:
        """Returns the function that the parent calls to tick this node."""
        return self.tree.entry_of(self, self.execute if self.guard is None else self.execute_guarded)

    def link(self) -> None:
        """Looks up how the children are ticked; called again after hooks were added or removed.

        A node that is being ticked continues with the list that it has.
        """
        self.ticks = []
        self.rewire()

    def rewire(self) -> None:
        """Looks up how the children are ticked, also for a tick of this node that is in progress."""
        self.ticks[:] = self.tree.entries_of(self.children)

    def prepare(self) -> None:
        """Initialises the node's state; called once, when the tree is complete."""

    def stop(self) -> None:
        """Halts the node as its parent does: its ``_onHalted`` runs afterwards."""
        if self.guard is None:
            self.halt()
        else:
            self.guard.stop(self)
        if self.journal is not None and self.reported is not IDLE:
            self.journal.touched.append(self)

    def complete(self, status: Status) -> Status:
        """Sets the node's own status to a result."""
        self.status = status
        if self.journal is not None:
            self.journal.results.append(self.marks[0] if status is SUCCESS else self.marks[1])
        return status

    def skipped(self) -> Status:
        """Returns SKIPPED, which leaves the node's status as it is."""
        if self.journal is not None:
            self.journal.results.append(self.marks[2])
        return SKIPPED

    def start(self) -> None:
        """Makes the node RUNNING."""
        self.status = RUNNING
        if self.journal is not None:
            self.journal.touched.append(self)

    def execute_guarded(self) -> Status:
        """Ticks a node that has pre- or post-conditions."""
        guard = self.guard
        if guard is None:  # a debugger may still give it one
            return self.execute()
        forced = guard.before(self)
        if forced is None:
            before = self.status
            status = self.execute()
            if status is RUNNING or status is SKIPPED:
                return status
            try:
                guard.after(self, status)
            except TickError:
                self.status = self.status_within(before)
                raise
            return status
        return self.decided(forced)

    def decided(self, status: Status) -> Status:
        """Gives the node a result without a tick: a pre-condition or a debugger has decided it."""
        if status is SKIPPED:
            return self.skipped()
        if status is RUNNING:
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        if self.guard is not None:  # else a debugger has just given it up
            self.guard.after(self, status)
        return self.complete(status)

    def status_within(self, before: Status) -> Status:
        """Returns the status that the node had while it was ticked, before its result was set."""
        return RUNNING if before in self.MARKS_RUNNING else before

    @property
    def ports_read(self) -> frozenset[str]:
        """The ports that were read since `note_early_reads`."""
        return frozenset(self.inputs) | (self.bound.read if self.bound is not None else frozenset())

    def note_early_reads(self) -> None:
        """Adds the ports that were read so far to `early`; called before the first tick."""
        self.early |= self.ports_read
        self.inputs.clear()
        if self.bound is not None:
            self.bound.read.clear()

    def get(self, port: str) -> Any:
        """Reads a port of the node.

        Raises:
            TickError: the port has no value, or a value of the wrong type.
        """
        try:
            return read_port(self, port)
        except PortError as error:
            raise TickError(self, str(error)) from None

    def get_or(self, port: str, otherwise: T) -> T:
        """Reads a port of the node; returns `otherwise` if it cannot be read."""
        try:
            return read_port(self, port)  # type: ignore[no-any-return]
        except PortError:
            return otherwise

    def put(self, port: str, value: Any) -> None:
        """Writes a port of the node.

        Raises:
            TickError: the port leads to no entry, or to an entry of another type.
        """
        try:
            write_port(self, port, value)
        except PortError as error:
            raise TickError(self, str(error)) from None


class Control(Node):
    """A node with children.

    Attributes:
        quick: the generated function for the usual course of a tick (`tree_gardener.generated`), or None.
    """

    __slots__ = ("quick",)
    KIND = Kind.CONTROL

    def link(self) -> None:
        """Looks up how the children are ticked; generated code is dropped."""
        super().link()
        self.quick: Callable[[], Any] | None = None

    def reset_children(self) -> None:
        """Halts the children that are RUNNING and makes all of them IDLE."""
        if self.journal is not None:
            self.journal.reset(self.children)
            return
        for child in self.children:
            if child.status is RUNNING:
                child.stop()
            child.status = IDLE

    def reset_child(self, index: int) -> None:
        """Halts one child if it is RUNNING, and makes it IDLE."""
        child = self.children[index]
        if self.journal is not None:
            self.journal.reset((child,))
            return
        if child.status is RUNNING:
            child.stop()
        child.status = IDLE

    def finish(self, status: Status) -> Status:
        """Resets all children and sets the node's own status to a result."""
        if self.journal is not None:
            self.journal.reset(self.children)
            self.journal.results.append(self.marks[0] if status is SUCCESS else self.marks[1])
        else:
            for child in self.children:
                if child.status is RUNNING:
                    child.stop()
                child.status = IDLE
        self.status = status
        return status

    def finish_all(self, status: Status) -> Status:
        """Does the same as `finish`, but faster, since no child can be RUNNING."""
        if self.journal is not None:
            self.journal.reset_done(self.children)
            self.journal.results.append(self.marks[0] if status is SUCCESS else self.marks[1])
        else:
            for child in self.children:
                child.status = IDLE
        self.status = status
        return status

    def finish_skipped(self) -> Status:
        """Resets all children and returns SKIPPED; the node's own status stays RUNNING."""
        self.reset_children()
        return self.skipped()

    def halt(self) -> None:
        """Halts all children; the node becomes IDLE."""
        self.reset_children()
        self.status = IDLE


class Decorator(Control):
    """A node with one child."""

    __slots__ = ("child", "tick_child")
    KIND = Kind.DECORATOR

    def link(self) -> None:
        """Looks up how the child is ticked; generated code is dropped."""
        self.child = self.children[0]
        super().link()

    def rewire(self) -> None:
        """Looks up how the child is ticked, also for a tick of this node that is in progress."""
        super().rewire()
        self.tick_child = self.ticks[0]

    def reset(self) -> None:
        """Halts the child if it is RUNNING, and makes it IDLE."""
        if self.journal is not None:
            self.journal.reset(self.children)
            return
        child = self.child
        if child.status is RUNNING:
            child.stop()
        child.status = IDLE

    def finish(self, status: Status) -> Status:
        """Resets the child and sets the node's own status to a result."""
        if self.journal is not None:
            self.journal.reset(self.children)
            self.journal.results.append(self.marks[0] if status is SUCCESS else self.marks[1])
        else:
            child = self.child
            if child.status is RUNNING:
                child.stop()
            child.status = IDLE
        self.status = status
        return status


class Leaf(Node):
    """A node without children."""

    __slots__ = ()
    KIND = Kind.ACTION
    MARKS_RUNNING = ()

    def link(self) -> None:
        """Does nothing: a leaf has no children."""

    def halt(self) -> None:
        """Makes the node IDLE."""
        self.status = IDLE


class SyncLeaf(Leaf):
    """A built-in leaf that is done within one tick."""

    __slots__ = ()

    def execute(self) -> Status:
        """Runs the leaf's work and sets the status to its result."""
        return self.complete(self.run())

    def run(self) -> Status:
        """Runs the leaf's work and returns its result."""
        return SUCCESS
