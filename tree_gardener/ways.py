"""The ways to tick a tree: the nodes' own methods, or generated code; and the shortest way into the root."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from tree_gardener.debugging.wiring import Wiring
from tree_gardener.deep import DEEP, DEEP_ASKING
from tree_gardener.generated.generation import Generation
from tree_gardener.hooks import Hooks
from tree_gardener.observe import Recorder

if TYPE_CHECKING:
    from tree_gardener.debugging.agent import Agent
    from tree_gardener.node import Execute, Node
    from tree_gardener.tree import Tree


class Ways:
    """The ways to tick one tree, and the choice between them.

    Whatever changes how nodes are ticked calls `link` or `link_around`, which choose again.

    Attributes:
        tick_root: ticks the root, with all that runs round it.
        is_plain: whether nothing is to be done round a tick, so that it may take the shortest way.
        generation: the generated code.
        deep: the depth beyond which ticks need more of Python's stack.
    """

    __slots__ = (
        "_hooks",
        "_is_due",
        "_recorder",
        "_tree",
        "_waits",
        "deep",
        "generation",
        "is_plain",
        "tick_root",
    )

    def __init__(self, tree: "Tree", hooks: Hooks, recorder: Recorder) -> None:
        self._tree = tree
        self._hooks = hooks
        self._recorder = recorder
        self.generation = Generation(tree, hooks, recorder)
        self.is_plain = True
        self.deep = DEEP
        self.tick_root: Execute
        self._waits = self._is_due = False

    @contextmanager
    def linked_once(self) -> Iterator[None]:
        """Between two ticks: `link` takes effect once, at the end."""
        self._waits = True
        try:
            yield
        finally:
            self._waits = False
            if self._is_due:
                self.link()

    def link(self) -> None:
        """Looks up again how each node is ticked, after hooks or observers changed."""
        self._is_due = self._waits
        if self._waits:
            return
        for node in self._tree.nodes:
            node.link()
        self.tick_root = self._tree.nodes[0].entry()
        self.generation.restart()
        self.choose()

    def rewire(self) -> None:
        """Looks up again how each node is ticked, also for a tick in progress."""
        for node in self._tree.nodes:
            node.rewire()
        if self._recorder.observers and self._tree.is_ticking:
            self._recorder.touched += self._tree.nodes  # generated code in progress reports later
        self.tick_root = self._tree.nodes[0].entry()
        self.generation.doubt()
        self.choose()

    def debug(self, agent: "Agent | None") -> None:
        """Attaches an agent in place of the last one; None detaches that."""
        hooks = self._hooks
        if hooks.wiring is not None:
            hooks.wiring.remove()
        hooks.wiring = None if agent is None else Wiring(self._tree, agent, self._recorder)
        self.deep = DEEP if agent is None else DEEP_ASKING
        self.rewire()
        if hooks.wiring is not None and agent is not None:
            agent.attach(hooks.wiring)

    def link_around(self, uid: int | None) -> None:
        """Looks up again how one node is ticked, or all (None), after a hook came or went."""
        nodes = self._tree.nodes
        if uid is None or not 0 < uid <= len(nodes):
            self.link()
            return
        node = nodes[uid - 1]
        if node.parent is None:
            self.tick_root = node.entry()
        else:
            node.parent.link()
        self.generation.drop(node)
        self.choose()

    def forget_code(self, node: "Node") -> None:
        """Removes the code in which a node is inlined, after one of its functions was replaced."""
        self.generation.drop(node)
        self.choose()

    def work(self) -> None:
        """Generates some of the code that is still to be generated; called between two ticks."""
        if self.generation.queue:
            self.generation.work()
            if not self.generation.queue:
                self.choose()

    def generate(self, *, on: bool) -> None:
        """Switches generated code on or off."""
        self.generation.enabled = on
        self.link()

    def source(self) -> str:
        """Generates all code that is still to be generated, and returns the source of all."""
        self.generation.finish()
        self.choose()
        return self.generation.source()

    def choose(self) -> None:
        """Chooses the shortest way if nothing is to be done round a tick."""
        self.is_plain = not (
            self._recorder.observers
            or self._tree.depth > self.deep
            or self._hooks.times_leaves
            or self.generation.queue
        )
