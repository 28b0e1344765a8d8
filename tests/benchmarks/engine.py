"""The engine beside stock py_trees and BehaviorTree.CPP with Python leaves, on the same trees in one run.

Times are of the processor, so that other programs disturb less; compare the ratios.
"""

from __future__ import annotations

import contextlib
import dataclasses
import gc
import html
import itertools
import mmap
import sys
import tracemalloc
from functools import partial
from typing import TYPE_CHECKING, Any

import behaviortreepy as cpp
import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.benchmarks.figures import Figure
from tests.benchmarks.timing import race
from tree_gardener import Tree
from tree_gardener.runner import Runner
from tree_gardener.script import compiled

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from tree_gardener.node import Node

SIZES = (10, 100, 1_000, 10_000)
LOADED = (1_000, 10_000, 20_000)
FAN = 10


class Succeed(py_trees.behaviour.Behaviour):
    """Always succeeds."""

    def update(self) -> PyTreesStatus:
        """Succeeds."""
        return PyTreesStatus.SUCCESS


class Run(py_trees.behaviour.Behaviour):
    """Is always RUNNING."""

    def update(self) -> PyTreesStatus:
        """Returns RUNNING."""
        return PyTreesStatus.RUNNING


NODES = {"Succeed": Succeed, "Run": Run}
STATUS = {"Succeed": cpp.NodeStatus.SUCCESS, "Run": cpp.NodeStatus.RUNNING}


def body(size: int, control: str = "Sequence", last: str = "Succeed") -> str:
    """XML of about `size` nodes: control nodes with ten children each; `last` is the last leaf."""
    if size <= 1:
        return f"<{last}/>"
    share = max(1, (size - 1) // FAN)
    parts, rest = [], size - 1
    while rest > 0:
        part = rest if rest - share < share else share
        parts.append(body(part, control, last if part == rest else "Succeed"))
        rest -= part
    return f"<{control}>{''.join(parts)}</{control}>"


def document(xml: str) -> str:
    """A document with one tree."""
    return f'<root BTCPP_format="4"><BehaviorTree ID="Main">{xml}</BehaviorTree></root>'


def warm(*ticks: Callable[[], object]) -> None:
    """Ticks trees until their code is generated, which happens a little in each tick."""
    for tick in ticks:
        for _ in range(100):
            tick()


def stock(node: Node) -> Any:
    """The same tree in stock py_trees."""
    if not node.children:
        return type(node.behaviour)(node.name)
    children = [stock(child) for child in node.children]
    if node.type == "ParallelAll":
        policy = py_trees.common.ParallelPolicy.SuccessOnAll(synchronise=False)
        return py_trees.composites.Parallel(node.name, policy, children=children)
    return py_trees.composites.Sequence(
        node.name, memory=not node.type.startswith("Reactive"), children=children
    )


def reference(xml: str) -> Any:
    """The same tree in BehaviorTree.CPP, with Python leaves."""
    factory = cpp.BehaviorTreeFactory()
    for name, status in STATUS.items():

        def callback(_node: Any, status: Any = status) -> Any:
            return status

        factory.register_simple_stateful_action(name, callback, callback, None)
    return factory.create_tree_from_text(document(xml))


@dataclasses.dataclass(frozen=True)
class Row:
    """One tree, in microseconds a tick."""

    what: str
    nodes: int
    ours: float
    observed: float
    stock: float
    tree: float
    cpp: float

    def __str__(self) -> str:
        return (
            f"{self.what:9} {self.nodes:6} {self.ours:10.2f} {self.observed:10.2f} {self.stock:11.1f} "
            f"{self.tree:11.1f} {self.cpp:10.2f} | "
            f"{self.stock / self.ours:7.1f}x {self.tree / self.ours:7.1f}x "
            f"{self.cpp / self.ours:6.2f}x  {100 * (self.observed / self.ours - 1):+6.0f} %"
        )


def row(what: str, xml: str, *, rounds: int = 7) -> Row:
    """Measures one tree in all engines."""
    text = document(xml)
    plain, observed = Tree.from_xml(text, NODES), Tree.from_xml(text, NODES)
    observed.observe(lambda changes: None)
    root = stock(plain.nodes[0])
    behaviour_tree = py_trees.trees.BehaviourTree(stock(plain.nodes[0]))
    warm(plain.tick_exactly_once, observed.tick_exactly_once)
    times = race(
        plain.tick_exactly_once,
        observed.tick_exactly_once,
        root.tick_once,
        behaviour_tree.tick,
        reference(xml).tick_exactly_once,
        rounds=rounds,
    )
    return Row(what, len(plain.nodes), *times)


def rows(sizes: tuple[int, ...] = SIZES, *, rounds: int = 7) -> list[Row]:
    """All measurements of ticks."""
    return [row(what, xml, rounds=rounds) for size in sizes for what, xml in shapes(size).items()]


def shapes(size: int) -> dict[str, str]:
    """The measured trees of a size."""
    return {
        "full": body(size),
        "resume": body(size, last="Run"),
        "reactive": body(size, "ReactiveSequence", last="Run"),
        "parallel": f"<ParallelAll>{'<Run/>' * (size - 1)}</ParallelAll>",
    }


@dataclasses.dataclass(frozen=True)
class UseRow:
    """One tree as users run it, in microseconds a tick."""

    what: str
    methods: float
    bare: float
    observed: float
    runner: float
    session: float
    application: float
    lockstep: float
    hooked: float

    def __str__(self) -> str:
        others = (
            *(self.observed, self.runner, self.session, self.application),
            *(self.lockstep, self.hooked),
        )
        methods = f"{self.methods:9.2f} ({self.bare / self.methods:4.2f}x)"
        return f"{self.what:9} {methods} {self.bare:9.2f} | " + " ".join(
            f"{us:9.2f} ({us / self.bare:5.2f}x)" for us in others
        )


SCRIPT = '<ScriptCondition code="1 &lt; 2"/>'


def use_rows(size: int = 1_000, *, rounds: int = 7) -> list[UseRow]:
    """Trees by the nodes' own methods, bare, observed, under a Runner, as in a session, and so on."""
    trees = shapes(size) | {"scripts": f"<Sequence>{SCRIPT * (size - 1)}</Sequence>"}
    found = []
    for what, xml in trees.items():
        methods, bare, observed, run, session, application, lockstep, hooked = (
            Tree.from_xml(document(xml), NODES) for _ in range(8)
        )
        methods.generate_code(on=False)
        for tree in (observed, session, application):
            tree.observe(lambda changes: None)
        # The manager reads from the memory of the application which action is in progress.
        application.current = memoryview(mmap.mmap(-1, mmap.PAGESIZE)).cast("I")
        lockstep.count_results()
        hooked.add_hook(after=lambda node, status: None)
        ticks = [tree.tick_exactly_once for tree in (methods, bare, observed)]
        calls = [*ticks, *(_under_runner(tree) for tree in (run, session, application, lockstep, hooked))]
        warm(*calls)
        found.append(UseRow(what, *race(*calls, rounds=rounds)))
    return found


def _under_runner(tree: Tree) -> Callable[[], object]:
    """Ticks a tree as a session does: by a Runner, at each of its times."""
    runner = Runner(tree, tick_hz=20, on_finish="repeat")
    times = itertools.count()
    return lambda: runner.tick_due(next(times) * 0.05)


CONDITIONS = (
    "battery &gt; 20.0",
    "count &lt;= 7 &amp;&amp; ready",
    "name == 'dock'",
    "0 &lt; battery &lt; 90",
)
SETTINGS = "battery := 55.5; count := 3; ready := true; name := 'dock'"


@dataclasses.dataclass(frozen=True)
class ScriptRow:
    """A sequence of ScriptConditions, in microseconds a tick."""

    what: str
    ours: float
    evaluated: float
    cpp: float

    def __str__(self) -> str:
        return (
            f"{self.what:24} {self.ours:10.2f} {self.evaluated:10.2f} {self.cpp:10.2f} | "
            f"{self.evaluated / self.ours:6.1f}x {self.cpp / self.ours:6.2f}x"
        )


def script_rows(size: int = 1_000, *, rounds: int = 7) -> list[ScriptRow]:
    """Sequences of ScriptConditions: compiled, left to the evaluator, and in BehaviorTree.CPP."""
    found = []
    for what, texts in (*((text, (text,)) for text in CONDITIONS), ("all of them", CONDITIONS)):
        leaves = "".join(f'<ScriptCondition code="{texts[index % len(texts)]}"/>' for index in range(size))
        xml = f'<Sequence><RunOnce><Script code="{SETTINGS}"/></RunOnce>{leaves}</Sequence>'
        ours = Tree.from_xml(document(xml), NODES)
        with interpreted():
            evaluated = Tree.from_xml(document(xml), NODES)
        trees = (ours, evaluated, reference(xml))
        plain = html.unescape(what)
        found.append(ScriptRow(plain, *race(*(tree.tick_exactly_once for tree in trees), rounds=rounds)))
    return found


@contextlib.contextmanager
def interpreted() -> Iterator[None]:
    """Leaves the scripts of trees that are loaded meanwhile to the evaluator."""
    compiled.COMPILES = False
    try:
        yield
    finally:
        compiled.COMPILES = True


def load_times(sizes: tuple[int, ...] = LOADED) -> list[tuple[int, float, float, float]]:
    """Size, and milliseconds to load: ours, BT.CPP, py_trees built by hand."""
    found = []
    for size in sizes:
        xml = body(size)
        ours, theirs, by_hand = (us / 1e3 for us in _load(xml))
        found.append((size, ours, theirs, by_hand))
    return found


def _load(xml: str) -> tuple[float, float, float]:
    text = document(xml)
    tree = Tree.from_xml(text, NODES)
    ours, other, by_hand = race(
        lambda: Tree.from_xml(text, NODES), lambda: reference(xml), lambda: stock(tree.nodes[0]), rounds=3
    )
    return ours, other, by_hand


def memory(size: int = 10_000) -> tuple[float, float, float]:
    """Returns bytes for each node: our whole tree, the leaves' own behaviours in it, and stock py_trees."""
    tree = Tree.from_xml(document(body(size)), NODES)
    leaves = sum(not node.children for node in tree.nodes)
    behaviours = bytes_of(lambda: [Succeed("Succeed") for _ in range(leaves)])
    theirs = bytes_of(lambda: stock(tree.nodes[0]))
    return own_bytes(size) / size, behaviours / size, theirs / size


def own_bytes(size: int) -> float:
    """Returns the bytes of our tree of a size."""
    text = document(body(size))
    return bytes_of(lambda: Tree.from_xml(text, NODES))


def bytes_of(make: Callable[[], object]) -> float:
    """Returns the bytes of Python's objects that a function makes and returns."""
    gc.collect()
    tracemalloc.start()
    kept = make()
    used = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    del kept
    return used


def measure(_: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields our own engine's figures, without its rivals."""
    sys.setrecursionlimit(10_000)
    for what, xml in shapes(1_000).items():
        plain, observed, session = (Tree.from_xml(document(xml), NODES) for _ in range(3))
        for tree in (observed, session):
            tree.observe(lambda changes: None)
        calls = (plain.tick_exactly_once, observed.tick_exactly_once, _under_runner(session))
        warm(*calls)
        for how, us in zip(("bare", "observed", "in a session"), race(*calls), strict=True):
            yield Figure(f"a tick of 1,000 nodes, {what}, {how}", us, "µs")
    for size in LOADED:
        load = partial(Tree.from_xml, document(body(size)), NODES)
        yield Figure(f"loading {size:,} nodes", race(load, rounds=3)[0] / 1e3, "ms")
    yield Figure("Python's objects of 10,000 nodes", own_bytes(10_000) / 1e6, "MB")


def main() -> None:
    """Prints everything."""
    sys.setrecursionlimit(10_000)
    py_trees.logging.level = py_trees.logging.Level.ERROR
    print("microseconds of processor time a tick; the ratios are the other engine's time to ours")
    print(
        f"{'tick':9} {'nodes':>6} {'ours':>10} {'observed':>10} {'tick_once()':>11} {'BT.tick()':>11} "
        f"{'BT.CPP':>10} | {'py_trees':>8} {'BT':>8} {'BT.CPP':>7}  observer"
    )
    for tick_row in rows():
        print(tick_row, flush=True)
    print("\n1,000 nodes as they are run; in brackets the ratio to the bare tick")
    print("methods: bare, but by the nodes' own methods; in brackets the ratio of generated code to it")
    heads = ("observed", "Runner", "session", "application", "lock-step", "hook of all")
    print(f"{'tick':9} {'methods':>17} {'bare':>9} | " + " ".join(f"{head:>18}" for head in heads))
    for use_row in use_rows():
        print(use_row, flush=True)
    print(
        f"\n{'1,000 ScriptConditions':24} {'ours':>10} {'evaluator':>10} {'BT.CPP':>10} | evaluator  BT.CPP"
    )
    for script_row in script_rows():
        print(script_row, flush=True)
    print("\nmilliseconds to load; py_trees is built by hand, without a document")
    for size, ours, other, by_hand in load_times():
        ratio = f"({ours / other:.1f} x)"
        print(f"{size:6} nodes: ours {ours:8.2f}, BT.CPP {other:8.2f} {ratio}, py_trees {by_hand:8.2f}")
    whole, behaviours, plain = memory()
    print(
        f"\nbytes a node at 10,000 nodes: ours {whole:.0f}, of these {behaviours:.0f} the behaviours "
        f"of the actions; stock py_trees {plain:.0f}"
    )


if __name__ == "__main__":
    main()
