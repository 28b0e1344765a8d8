"""A tree with ROS nodes on a real rclpy node, beside servers on another one, in this process."""

from __future__ import annotations

import contextlib
import itertools
import time
from typing import TYPE_CHECKING, Any

from tests.deadline import DEADLINE_S
from tests.domains import own_domain_id
from tests.tree_gardener.trees import document
from tree_gardener import ManualClock, Status, Tree

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

DOMAIN_ID = own_domain_id()
_numbers = itertools.count()


class Graph:
    """The two nodes, and an executor that spins both. The tree has a clock of its own, moved by hand."""

    def __init__(self, context: Any) -> None:
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node

        # Servers of the last test may be seen for a moment longer: each graph has a namespace of its own.
        space = f"graph{next(_numbers)}"
        self.tree_node = Node("tree", namespace=space, context=context)
        self.other = Node("other", namespace=space, context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.tree_node)
        self.executor.add_node(self.other)
        self.clock = ManualClock()
        self.nodes: Mapping[str, type] = {}
        self.tree: Tree

    def load(self, body: str, **entries: Any) -> Tree:
        """Loads a tree and sets it up."""
        self.tree = Tree.from_xml(document(body), clock=self.clock, nodes=self.nodes)
        for key, value in entries.items():
            self.tree.blackboard[key] = value
        self.tree.setup(node=self.tree_node)
        return self.tree

    def spin(self, until: Callable[[], bool]) -> None:
        """Handles messages until something has happened."""
        deadline = time.monotonic() + DEADLINE_S
        while not until():
            assert time.monotonic() < deadline, "it did not happen in time"
            self.executor.spin_once(timeout_sec=0.02)

    def run(self, body: str = "", **entries: Any) -> Status:
        """Ticks, with messages in between, until the tree is not RUNNING; no time passes meanwhile."""
        if body:
            self.load(body, **entries)
        last = [Status.RUNNING]

        def is_over() -> bool:
            last[0] = self.tree.tick_exactly_once()
            return last[0] is not Status.RUNNING

        self.spin(is_over)
        return last[0]

    def __getitem__(self, key: str) -> Any:
        return self.tree.blackboard[key]


@contextlib.contextmanager
def graph() -> Iterator[Graph]:
    """Yields a graph; ends it afterwards."""
    import rclpy
    from rclpy.context import Context

    context = Context()
    rclpy.init(context=context, domain_id=DOMAIN_ID)
    made = Graph(context)
    try:
        yield made
    finally:
        if hasattr(made, "tree"):
            made.tree.shutdown()
        made.executor.shutdown()
        made.tree_node.destroy_node()
        made.other.destroy_node()
        context.try_shutdown()
