"""The cost of a debugger: attached without breakpoints, with breakpoints that are not hit, and at a stop."""

from __future__ import annotations

import dataclasses
import statistics
import time
from typing import TYPE_CHECKING

from tests.benchmarks.engine import NODES, body, document, warm
from tests.benchmarks.timing import race
from tree_gardener import Status, Tree
from tree_gardener.debugging import Breakpoint, Debugger, Step, Stop, When, place_of

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclasses.dataclass(frozen=True)
class Row:
    """One tree. Ratios are to `without`, of ticks that came in turn: their medians.

    Attributes:
        what: the tree.
        without: a tick by generated code, in microseconds.
        methods: the ratio of the nodes' own methods.
        attached: that of a debugger that has no breakpoints.
        results: with breakpoints on a result that does not come.
        conditions: with breakpoints before the tick, whose condition is false.
        written: likewise, and what the condition reads is written before each tick.
        distinct: as `written`, with another condition at each node.
        step: of one step between two stops, in microseconds.
    """

    what: str
    without: float
    methods: float
    attached: float
    results: float
    conditions: float
    written: float
    distinct: float
    step: float

    def __str__(self) -> str:
        ratios = (self.methods, self.attached, self.results, self.conditions, self.written, self.distinct)
        shown = " ".join(f"{ratio:9.2f}x" for ratio in ratios)
        return f"{self.what:18} {self.without:9.2f} | {shown} | {self.step:9.2f}"


def rows(size: int = 1_000, count: int = 100, *, rounds: int = 60) -> list[Row]:
    """Trees by methods, with generated code, with a debugger, and with `count` breakpoints.

    Those that are observed have their leaves marked, as in a session.
    """
    found = []
    for what, xml in (("full", body(size)), ("reactive", body(size, "ReactiveSequence", last="Run"))):
        for is_observed in (False, True):
            trees = [_tree(xml, is_observed=is_observed) for _ in range(7)]
            _, methods, attached, results, conditions, written, distinct = trees
            methods.generate_code(on=False)
            attached.debug(Debugger(_never))
            nodes = results.nodes[1 :: max(1, size // count)][:count]
            places = [place_of(node, one_instance=True) for node in nodes]
            _debug(results, [Breakpoint(place, When.RETURNS, Status.FAILURE) for place in places])
            for tree in (conditions, written):
                _debug(tree, [Breakpoint(place, condition="battery < 20") for place in places])
            others = [f"battery < {number / 10}" for number in range(len(places))]
            pairs = zip(places, others, strict=True)
            _debug(distinct, [Breakpoint(place, condition=text) for place, text in pairs])
            calls = [tree.tick_exactly_once for tree in trees[:5]] + [_writing(written), _writing(distinct)]
            warm(*calls)
            without, ratios = _in_turn(calls, rounds)
            name = f"{what}, observed" if is_observed else what
            columns = [without, *ratios, _step_us(xml)]
            found.append(Row(name, *columns))
    return found


def _in_turn(calls: list[Callable[[], object]], rounds: int, turn: int = 20) -> tuple[float, list[float]]:
    """Returns the least µs of the first call, and the median of each other's ratio to it, turn by turn.

    A program beside it disturbs some turns, and both calls of one.
    """
    least, ratios = float("inf"), []
    for _ in range(rounds):
        times = []
        for call in calls:
            start_s = time.thread_time()
            for _ in range(turn):
                call()
            times.append(time.thread_time() - start_s)
        least = min(least, times[0] / turn)
        ratios.append([each / times[0] for each in times[1:]])
    return least * 1e6, [statistics.median(column) for column in zip(*ratios, strict=True)]


def _tree(xml: str, *, is_observed: bool) -> Tree:
    tree = Tree.from_xml(document(xml), NODES)
    tree.blackboard["battery"] = 80.0
    if is_observed:
        tree.observe(lambda changes: None)
        tree.mark_leaves()
    return tree


def _writing(tree: Tree) -> Callable[[], object]:
    """Writes what the conditions read, and ticks."""

    def tick() -> None:
        tree.blackboard["battery"] = 80.0
        tree.tick_exactly_once()

    return tick


def _debug(tree: Tree, breakpoints: list[Breakpoint]) -> None:
    debugger = Debugger(_never)
    tree.debug(debugger)
    debugger.set_breakpoints(breakpoints)


def _never(stop: Stop) -> None:
    raise AssertionError(f"nothing stops at {stop}")


def _step_us(xml: str) -> float:
    """The time from a hit to the next one, with one step, where each stop switches all nodes."""
    tree = Tree.from_xml(document(xml), NODES)

    def hold(_stop: Stop) -> None:
        debugger.resume(Step.CONTINUE)

    debugger = Debugger(hold)
    tree.debug(debugger)
    debugger.set_breakpoints([Breakpoint(place_of(tree.nodes[-1], one_instance=True))])
    return race(tree.tick_exactly_once, rounds=3)[0]


def main() -> None:
    """Prints the table."""
    print(
        "debugger: µs without | by methods, attached, 100 breakpoints not hit: on a result, with a condition,"
        " which reads what is written in each tick, with 100 of these | µs of a tick with one stop"
    )
    for row in rows():
        print(row)
