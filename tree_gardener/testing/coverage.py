"""Coverage of trees: the items that the tests have reached, out of those that can be reached.

The items of a node: that it was ticked; each result that it can return; each branch of a fallback, switch, if
or while taken and not taken; each pre-condition true and false; each post-condition run; that it was halted
while RUNNING, where something can halt it.
"""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.conditions import Condition
from tree_gardener.node import Node
from tree_gardener.status import RUNNING, Status
from tree_gardener.testing.outcomes import haltable, outcomes

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

Seen = Mapping[str, Mapping[str, tuple[str, ...]]]
Log = list[tuple[int, Status]]

TICKED: Final = "ticked"
HALTED: Final = "halted while RUNNING"
_DECIDING: Final = ("_failureIf", "_successIf", "_skipIf")
_RESULTS: Final = {TICKED, *(status.name for status in Status)}
_ENDING: Final = {
    "_onSuccess": "on_success",
    "_onFailure": "on_failure",
    "_post": "post",
    "_onHalted": "on_halted",
}
_LATER: Final = {"Fallback", "AsyncFallback", "ReactiveFallback", "TryCatch"}
_EITHER: Final = {"IfThenElse", "WhileDoElse"}


def key_of(node: Node) -> str:
    """Returns the key of a node within its tree: its id in the diagram, or else its place in the document."""
    return node.node_id or f"{node.type}@{node.element.offset}"


def branches(node: Node) -> range:
    """Returns the indices of the children that are branches of a node."""
    if node.type.startswith("Switch"):
        return range(len(node.children))
    return range(1, len(node.children)) if node.type in _LATER or node.type in _EITHER else range(0)


class Watch:
    """Observes the items that a run of one tree reaches.

    Attributes:
        log: results of the nodes in this tick, in order; the tree appends to it.
        last: the last result of each node that was ticked in this tick, by uid.
        ticked: how often each node was ticked, by uid.
        halts: how often each node was halted while RUNNING, by uid.
    """

    def __init__(self, tree: "Tree") -> None:
        self.nodes = tree.nodes
        self.log: Log = tree.log_results()
        self.last: dict[int, Status] = {}
        self.ticked: dict[int, int] = dict.fromkeys(range(1, len(tree.nodes) + 1), 0)
        self.halts: dict[int, int] = dict.fromkeys(self.ticked, 0)
        self.results: set[tuple[int, Status]] = set()
        self.items: set[tuple[int, str]] = set()
        self._running: set[int] = set()
        self._branching = {node.uid for node in tree.nodes if branches(node)}
        self._child = {
            child.uid: (node.uid, i) for node in tree.nodes for i, child in enumerate(node.children)
        }
        for node in tree.nodes:
            if node.guard is not None:
                self._watch_conditions(node)

    def take(self) -> None:
        """Adds the changes of a tick."""
        log = self.log
        self.last = dict(log)
        self.results.update(log)
        running, ticked = self._running, self.ticked
        for uid, status in log:
            ticked[uid] += 1
            if status is RUNNING:
                running.add(uid)
            else:
                running.discard(uid)
        if self._branching:
            self._take_branches()
        log.clear()
        nodes = self.nodes
        for uid in [uid for uid in running if nodes[uid - 1].status is not RUNNING]:
            running.discard(uid)
            self.halts[uid] += 1

    def _take_branches(self) -> None:
        taken: dict[int, set[int]] = {}
        for uid, status in self.log:
            if uid in self._branching:
                self._branch(self.nodes[uid - 1], status, taken.pop(uid, set()))
            above, index = self._child.get(uid, (0, 0))
            if above in self._branching:
                taken.setdefault(above, set()).add(index)

    def _branch(self, node: Node, status: Status, taken: set[int]) -> None:
        is_later = node.type in _LATER
        if not taken or (is_later and status is RUNNING and node.type != "ReactiveFallback"):
            left: Iterable[int] = ()
        elif is_later:
            left = range(max(taken) + 1, len(node.children))
        else:
            left = (index for index in branches(node) if index not in taken)
        choices = branches(node)
        self.items.update((node.uid, f"branch {i + 1} taken") for i in taken if i in choices)
        self.items.update((node.uid, f"branch {i + 1} not taken") for i in left if i in choices)

    def _watch_conditions(self, node: Node) -> None:
        guard = node.guard
        assert guard is not None
        names = [name for name in _DECIDING if name in node.attributes]
        for name, (condition, _) in zip(names, guard.deciding, strict=True):
            self._wrap(node.uid, name, condition, decides=True)
        if guard.while_true is not None:
            self._wrap(node.uid, "_while", guard.while_true, decides=True)
        for name, attribute in _ENDING.items():
            ending = getattr(guard, attribute)
            if ending is not None:
                self._wrap(node.uid, name, ending, decides=False)

    def _wrap(self, uid: int, name: str, condition: Condition, *, decides: bool) -> None:
        inner, items = condition.call, self.items

        def call() -> Any:
            value = inner()
            items.add((uid, f"{name} {'true' if value else 'false'}" if decides else f"{name} run"))
            return value

        condition.call = call

    def seen(self) -> Seen:
        """Returns the items that the run has reached, by tree and node."""
        found: dict[str, dict[str, set[str]]] = {}

        def add(uid: int, *items: str) -> None:
            node = self.nodes[uid - 1]
            found.setdefault(node.tree_id, {}).setdefault(key_of(node), set()).update(items)

        for uid, status in self.results:
            add(uid, TICKED, status.name)
        for uid, item in self.items:
            add(uid, item)
        for uid, count in self.halts.items():
            if count:
                add(uid, HALTED)
        return {
            tree: {node: tuple(sorted(items)) for node, items in sorted(nodes.items())}
            for tree, nodes in sorted(found.items())
        }


class Coverage:
    """The parts of all trees that the tests have reached, and the parts that are missing.

    Args:
        results_only: whether only ticks and results count.
    """

    def __init__(self, *, results_only: bool = False) -> None:
        self.results_only = results_only
        self.wanted: dict[str, dict[str, list[str]]] = {}
        self.names: dict[tuple[str, str], tuple[str, str]] = {}
        self.reached: dict[str, dict[str, set[str]]] = {}

    def add_tree(self, tree: "Tree", returns: Mapping[str, frozenset[str]]) -> None:
        """Adds the nodes of a tree and of its SubTrees to the items that can be reached."""
        possible = outcomes(tree.nodes, returns)
        can_halt = haltable(tree.nodes, possible)
        for node, results, halts in zip(tree.nodes, possible, can_halt, strict=True):
            key = key_of(node)
            self.names[node.tree_id, key] = (node.name, node.type)
            held = self.wanted.setdefault(node.tree_id, {}).setdefault(key, [])
            for item in _items(node, results, halts=halts):
                if item not in held and not (self.results_only and item not in _RESULTS):
                    held.append(item)

    def add_seen(self, seen: Seen) -> None:
        """Adds the items that a test has reached."""
        for tree, nodes in seen.items():
            for node, items in nodes.items():
                self.reached.setdefault(tree, {}).setdefault(node, set()).update(items)

    def missing(self) -> list[tuple[str, str, str]]:
        """Returns the items that no test has reached, with tree and node."""
        return [
            (tree, node, item)
            for tree, nodes in self.wanted.items()
            for node, items in nodes.items()
            for item in items
            if item not in self._reached(tree, node)
        ]

    @property
    def share(self) -> float:
        """The reached part of all items; 1 if there are none."""
        return _share(self._count(tree) for tree in self.wanted)

    def _reached(self, tree: str, node: str) -> set[str]:
        return self.reached.get(tree, {}).get(node, set())

    def _count(self, tree: str) -> tuple[int, int]:
        nodes = self.wanted[tree]
        reached = sum(item in self._reached(tree, node) for node, items in nodes.items() for item in items)
        return reached, sum(map(len, nodes.values()))

    def to_json(self) -> dict[str, Any]:
        """Returns shares and items: of all, by tree and by node."""
        return {
            "format": "bt-studio/coverage",
            "version": 1,
            "share": round(self.share, 6),
            "trees": {
                tree: {
                    "share": round(_share([self._count(tree)]), 6),
                    "nodes": {
                        node: {
                            "name": self.names[tree, node][0],
                            "type": self.names[tree, node][1],
                            "items": {item: item in self._reached(tree, node) for item in items},
                        }
                        for node, items in nodes.items()
                    },
                }
                for tree, nodes in self.wanted.items()
            },
        }


def _share(counts: Iterable[tuple[int, int]]) -> float:
    pairs = list(counts)
    total = sum(count for _, count in pairs)
    return sum(count for count, _ in pairs) / total if total else 1.0


def _items(node: Node, results: frozenset[Status], *, halts: bool) -> list[str]:
    items = [TICKED, *(status.name for status in Status if status in results)]
    for index in branches(node):
        items += [f"branch {index + 1} taken", f"branch {index + 1} not taken"]
    for name in (*_DECIDING, "_while"):
        if name in node.attributes:
            items += [f"{name} true", f"{name} false"]
    items += [f"{name} run" for name in _ENDING if name in node.attributes]
    return [*items, HALTED] if halts else items
