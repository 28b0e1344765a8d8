"""Runs a random tree with and without generated code, and records all that can be seen of it.

Each call of a leaf records the statuses of all nodes and behaviours at this moment. Between ticks hooks,
observers, marks and counts come and go, by the same random numbers in both runs.
"""

from __future__ import annotations

import dataclasses
import functools
import random
from typing import TYPE_CHECKING, Any

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import KEYS, SHARED, Case, Spec, generate
from tree_gardener import Status, TickError, Tree
from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.clock import ManualClock
from tree_gardener.errors import LoadError
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.ports import node_of
from tree_gardener.values import INT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tree_gardener.observe import TickChanges

RESULTS: dict[str, Any] = {
    "S": PyTreesStatus.SUCCESS,
    "F": PyTreesStatus.FAILURE,
    "R": PyTreesStatus.RUNNING,
    "K": Status.SKIPPED,
    "V": PyTreesStatus.INVALID,
    "s": Status.SUCCESS,
    "I": Status.IDLE,
    "N": None,
}
USUAL, RARE = "SSSSFFFRRK", "SSSSFFFRRKEXVsINH"
KEPT = 512
MOST_REPLACED = 100
"""The most results that one hook replaces."""
WIDE = ("Sequence", "Fallback", "ReactiveSequence", "ReactiveFallback", "ParallelAll")


def wide(case: Case) -> Case:
    """A case whose root is a control node with more children than one function ticks."""
    chance = random.Random(case.seed)  # noqa: S311 - a reproducible case, no secret
    leaves = [
        Spec(chance.choice(("Leaf", "Leaf", "SyncLeaf", "Cond", "Plain")), (("name", f"W{index}"),))
        for index in range(chance.randint(17, 50))
    ]
    leaves[chance.randrange(len(leaves))] = case.trees[0][1]
    root = Spec(chance.choice(WIDE), (), tuple(leaves))
    return dataclasses.replace(case, trees=(("Main", root), *case.trees[1:]))


class Run:
    """One run of a case.

    Attributes:
        seen: everything that was seen, in order.
    """

    def __init__(self, case: Case, *, is_generated: bool, letters: str, changes: bool) -> None:
        self.case = case
        # What was seen before a halt within a tick may be in the observers' next report.
        self.letters = letters.replace("H", "") if changes else letters
        self.chance = random.Random(case.seed)  # noqa: S311
        self.changes = changes
        self.seen: list[Any] = []
        self.undo: list[Callable[[], None]] = []
        self.calls: dict[tuple[str, str], int] = {}
        self.board = Blackboard()
        for key in KEYS:
            self.board.set(key, 1, INT)
        self.tree = Tree.from_xml(case.xml(), self.nodes(), ManualClock(), blackboard=self.board)
        self.tree.generate_code(on=is_generated)
        self.tree.on_warning = lambda node, message: self.seen.append(("warning", node.uid, message))
        if self.chance.random() < 0.4:
            self.tree.on_error = lambda error: self.seen.append(("error", str(error)))

    def nodes(self) -> dict[str, Any]:
        """The leaves: with and without each method, of each kind."""
        run = self

        class Plain(py_trees.behaviour.Behaviour):
            def update(self) -> Any:
                return run.answer(self, "update")

        class Leaf(Plain):
            def initialise(self) -> None:
                run.answer(self, "initialise")

            def terminate(self, new_status: PyTreesStatus) -> None:
                run.answer(self, f"terminate {new_status.name}")

        class SyncLeaf(Plain):
            NODE_KIND = "SyncAction"

            def terminate(self, new_status: PyTreesStatus) -> None:
                run.answer(self, f"terminate {new_status.name}")

        class Cond(Plain):
            NODE_KIND = "Condition"

            def initialise(self) -> None:
                run.answer(self, "initialise")

        return {"Leaf": Leaf, "SyncLeaf": SyncLeaf, "Cond": Cond, "Plain": Plain}

    def answer(self, behaviour: Any, what: str) -> Any:
        """Records a call, and returns a random result of this leaf and call."""
        node = node_of(behaviour)
        self.seen.append((what, node.uid, self.state(), self.tree.current_uid))
        count = self.calls[node.path, what] = self.calls.get((node.path, what), 0) + 1
        chance = random.Random(f"{self.case.seed} {node.path} {what} {count}")  # noqa: S311
        letters = self.letters if what == "update" else "S" * 20 + self.letters[10:12]
        letter = chance.choice(letters)
        if letter == "H":
            self.tree.halt()
            letter = chance.choice("SFR")
        if letter == "E":
            raise ValueError(f"{what} {count}")
        if letter == "X":
            raise SystemExit(count)
        return RESULTS[letter]

    def state(self) -> str:
        """The statuses of all nodes, and of all behaviours."""
        nodes = self.tree.nodes
        own = "".join(node.status.letter for node in nodes)
        return own + "".join(
            node.behaviour.status.name[0] for node in nodes if isinstance(node, BehaviourLeaf)
        )

    def run(self) -> list[Any]:
        """Ticks the tree as the case says; returns what was seen."""
        for tick in range(self.case.ticks):
            if self.changes:
                self.change()
            if tick in self.case.halts:
                self.tick(self.tree.halt)
            for when, key, value in self.case.writes:
                if when == tick:
                    self.board.set(key, value, INT)
            self.tick(self.tree.tick_once if self.case.mode == "once" else self.tree.tick_exactly_once)
        self.tick(self.tree.halt)
        return self.seen

    def tick(self, function: Callable[[], Any]) -> None:
        """Ticks or halts the tree, and records the state afterwards."""
        try:
            self.seen.append(function())
        except TickError as error:
            self.seen.append(
                ("raised", str(error), error.file.rpartition("/")[2], error.line, error.traceback_text)
            )
        values = {
            key: None if entry.value is EMPTY else entry.value for key, entry in self.board.entries.items()
        }
        self.seen.append((self.state(), values, self.tree.current_uid))
        if self.tree._hooks.counts is not None:
            self.seen.append([dataclasses.astuple(count) for count in self.tree.count_results()])

    def change(self) -> None:
        """Adds or removes a hook, an observer, marks or counts."""
        chance, tree = self.chance, self.tree
        kind = chance.random()
        if kind < 0.5:
            return
        if self.undo and kind < 0.65:
            self.undo.pop(chance.randrange(len(self.undo)))()
        elif kind < 0.75:
            self.undo.append(tree.observe(self.changed))
        elif kind < 0.85:
            self.undo.append(self.hook(chance.choice((None, *tree.nodes))))
        elif kind < 0.9:
            tree.mark_leaves(on=chance.random() < 0.7)
        elif kind < 0.95:
            tree.time_leaves(on=chance.random() < 0.7)
        else:
            tree.count_results()

    def hook(self, node: Any) -> Callable[[], None]:
        """Adds hooks that record, and now and then replace a result."""
        replaced = self.chance.choice(
            (None, None, Status.SUCCESS, Status.FAILURE, Status.RUNNING, Status.SKIPPED)
        )
        is_before = self.chance.random() < 0.5
        # A node that wakes the tree up and is RUNNING forever would keep `tick_once` forever.
        left = iter(range(MOST_REPLACED))

        def before(node: Any) -> Status | None:
            self.seen.append(("before", node.uid, self.state(), self.tree.current_uid))
            return replaced if is_before and next(left, None) is not None else None

        def after(node: Any, status: Status) -> Status | None:
            self.seen.append(("after", node.uid, status, self.state(), self.tree.current_uid))
            return None if is_before or next(left, None) is None else replaced

        return self.tree.add_hook(before=before, after=after, node=node)

    def changed(self, changes: TickChanges) -> None:
        """Records the report of an observer."""
        board = [(change.key, change.value, change.writer_uid) for change in changes.blackboard]
        changed = sorted(changes.changed, key=lambda pair: pair[0])
        self.seen.append((changes.tick, changed, changes.flashed, board))


@functools.lru_cache(KEPT)
def general(case: Case, letters: str, *, changes: bool) -> list[Any]:
    """Returns what is seen of a run by the nodes' own methods, to which several suites compare others."""
    return Run(case, is_generated=False, letters=letters, changes=changes).run()


def compare(case: Case, letters: str = USUAL, *, changes: bool = False) -> tuple[int, int]:
    """Compares a case run both ways; returns how much was seen, and how many nodes had code at the end.

    Raises:
        AssertionError: the runs differ.
    """
    plain = general(case, letters, changes=changes)
    run = Run(case, is_generated=True, letters=letters, changes=changes)
    generated = run.run()
    for index, (expected, found) in enumerate(zip(plain, generated, strict=False)):
        assert expected == found, (
            f"seed {case.seed}, entry {index}:\n{case.xml()}\ngeneral   {expected}\ngenerated {found}"
        )
    assert len(plain) == len(generated)
    return len(plain), sum(getattr(node, "quick", None) is not None for node in run.tree.nodes)


def cases(first: int, count: int) -> list[Case]:
    """Random cases of which the engine loads each."""
    return list(loadable(range(first, first + count)))


def loadable(seeds: range) -> Iterator[Case]:
    """Makes the random cases of which the engine loads each, one at a time."""
    yield from filter(None, map(loaded, seeds))


@functools.lru_cache(SHARED)
def loaded(seed: int) -> Case | None:
    """The case of a seed, a wide one for each third, or None where the engine does not load it."""
    case = generate(seed)
    if seed % 3 == 0:
        case = wide(case)
    try:
        Run(case, is_generated=False, letters=USUAL, changes=False)
    except LoadError:
        return None
    return case
