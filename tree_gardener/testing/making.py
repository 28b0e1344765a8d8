"""Makes a behaviour test of a run of a tree: its doubles return the results that the leaves returned."""

from collections.abc import Callable, Iterable
from typing import Any, Final

from tree_gardener.blackboard import Entry
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.node import Node
from tree_gardener.ports import INPUT, pointer_key
from tree_gardener.status import FAILURE, IDLE, RUNNING, Status
from tree_gardener.testing.reading import FORMAT, VERSION
from tree_gardener.tree import Tree

MAX_EXPECTATIONS: Final = 200
_PLAIN: Final = (str, int, float, bool)

Step = tuple[str, dict[str, Any]]


class Maker:
    """Observes a tree from its first tick on, and makes a test of it.

    Args:
        tree: the tree, after `setup` and before its first tick.
        tick_hz: the rate at which it is ticked.

    Attributes:
        problems: sentences about the parts of the run that the test cannot repeat.
    """

    def __init__(self, tree: Tree, tick_hz: float) -> None:
        self.tree = tree
        self.tick_hz = tick_hz
        self.problems: list[str] = []
        self._leaves = [node for node in tree.nodes if isinstance(node, BehaviourLeaf)]
        self._steps: dict[int, list[Step]] = {node.uid: [] for node in self._leaves}
        self._statuses: dict[int, list[Status]] = {node.uid: [] for node in self._leaves}
        self._roots: list[Status] = []
        self._written: list[tuple[Entry, int]] = []
        self._log = tree.log_results()
        self._ticked = dict.fromkeys(self._steps, 0)
        self._board = {
            key: entry.value for key, entry in tree.blackboard.entries.items() if _is_plain(entry.value)
        }
        for board in tree.boards:
            board.journal = self._noting(board.journal)
        for node in self._leaves:
            node.update = self._watched(node, node.update)

    @property
    def ticks(self) -> int:
        """The number of ticks so far."""
        return len(self._roots)

    def after_tick(self, root: Status) -> None:
        """Takes over a tick with its result."""
        self._roots.append(root)
        for uid, _ in self._log:
            if uid in self._ticked:
                self._ticked[uid] += 1
        self._log.clear()
        for node in self._leaves:
            self._statuses[node.uid].append(node.status)

    def test(self, name: str) -> dict[str, Any]:
        """Returns the test, as one of the ``tests`` of a document."""
        keys = {node.uid: self._key(node) for node in self._leaves}
        doubles = {keys[uid]: _steps(steps) for uid, steps in self._steps.items() if steps}
        end: dict[str, Any] = {"at": "end", "root": self._roots[-1].name}
        if self._leaves:
            end["ticked"] = {keys[uid]: count for uid, count in self._ticked.items()}
        expect = [
            {"at": _range(first, last), "node": keys[node.uid], "status": status.name}
            for node in self._leaves
            for first, last, status in _stretches(self._statuses[node.uid])
        ]
        test: dict[str, Any] = {"name": name, "tree": self.tree.nodes[0].tree_id}
        if self._board:
            test["blackboard"] = self._board
        if doubles:
            test["doubles"] = doubles
        test |= {"tick_hz": self.tick_hz, "ticks": len(self._roots)}
        if any(status is not RUNNING for status in self._roots[:-1]):
            test["repeat"] = True
        return {**test, "expect": [*expect[:MAX_EXPECTATIONS], end]}

    def document(self, name: str) -> dict[str, Any]:
        """Returns a document with the one test."""
        return {"format": FORMAT, "version": VERSION, "tests": [self.test(name)]}

    def _key(self, node: Node) -> str:
        """Returns the shortest key that means this node alone."""
        nodes = self.tree.nodes
        for key in (node.name, node.path):
            if sum(key in (other.name, other.type, other.path, other.node_id) for other in nodes) == 1:
                return key
        self.problems.append(f"several nodes are called '{node.path}': give them different names")
        return node.path

    def _noting(self, before: Callable[[Entry, int], None] | None) -> Callable[[Entry, int], None]:
        def note(entry: Entry, writer: int) -> None:
            if before is not None:
                before(entry, writer)
            self._written.append((entry, writer))

        return note

    def _watched(self, node: BehaviourLeaf, update: Callable[[], Any]) -> Callable[[], Any]:
        def watched() -> Any:
            self._written.clear()
            returned = update()
            name = str(getattr(returned, "name", ""))
            status = name if name in Status.__members__ and name != IDLE.name else FAILURE.name
            self._steps[node.uid].append((status, self._outputs(node)))
            return returned

        return watched

    def _outputs(self, node: BehaviourLeaf) -> dict[str, Any]:
        """Returns the values that a leaf wrote to its output ports in this tick."""
        written = {id(entry): entry for entry, writer in self._written if writer == node.uid}
        if not written:
            return {}
        manifest = node.manifest
        names: Iterable[str] = node.ports if manifest is None else manifest
        found = {}
        for name in names:
            spec = None if manifest is None else manifest[name]
            if spec is not None and spec.direction == INPUT:
                continue
            text = node.ports.get(name, spec.default if spec is not None else "")
            key = pointer_key(text, name) if isinstance(text, str) else None
            entry = node.board.find(key) if key is not None else None
            if entry is None or written.pop(id(entry), None) is None:
                continue
            if _is_plain(entry.value):
                found[name] = entry.value
            else:
                self.problems.append(f"the value that '{node.path}' wrote to '{name}' has no form in YAML")
        if written:
            self.problems.append(f"'{node.path}' wrote to entries that are no ports of it")
        return found


def _is_plain(value: Any) -> bool:
    if isinstance(value, list):
        return len(value) <= 1000 and all(isinstance(item, _PLAIN) for item in value)
    return isinstance(value, _PLAIN)


def _steps(steps: list[Step]) -> Any:
    """Returns the steps of a double in the short form: equal neighbours become one."""
    merged: list[tuple[Step, int]] = []
    for step in steps:
        if merged and merged[-1][0] == step:
            merged[-1] = (step, merged[-1][1] + 1)
        else:
            merged.append((step, 1))
    written = []
    for index, ((status, outputs), times) in enumerate(merged):
        item: dict[str, Any] = {"status": status}
        if times > 1 and index + 1 < len(merged):
            item["times"] = times
        if outputs:
            item["outputs"] = outputs
        written.append(item if len(item) > 1 else status)
    return written[0] if len(written) == 1 else written


def _stretches(statuses: list[Status]) -> list[tuple[int, int, Status]]:
    """Returns first tick, last tick and status of each stretch without a change."""
    found: list[tuple[int, int, Status]] = []
    for tick, status in enumerate(statuses, start=1):
        if found and found[-1][2] is status:
            found[-1] = (found[-1][0], tick, status)
        else:
            found.append((tick, tick, status))
    return found


def _range(first: int, last: int) -> int | str:
    return first if first == last else f"{first}..{last}"
