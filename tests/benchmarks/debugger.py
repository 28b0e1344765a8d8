"""The cost of a debugger: attached without breakpoints, with breakpoints that are not hit, and at a stop."""

from __future__ import annotations

import dataclasses

from tests.benchmarks.engine import NODES, body, document, race, warm
from tree_gardener import Status, Tree
from tree_gardener.debugging import Breakpoint, Debugger, Step, Stop, When, place_of


@dataclasses.dataclass(frozen=True)
class Row:
    """One tree, in microseconds a tick.

    Attributes:
        what: the tree.
        methods: by the nodes' own methods.
        without: by generated code, as all that follows.
        attached: with a debugger that has no breakpoints.
        results: with breakpoints on a result that does not come.
        conditions: with breakpoints before the tick, whose condition is false.
        step: of one step between two stops.
    """

    what: str
    methods: float
    without: float
    attached: float
    results: float
    conditions: float
    step: float

    def __str__(self) -> str:
        ratios = " ".join(
            f"{us:9.2f} ({us / self.without:5.2f}x)" for us in (self.attached, self.results, self.conditions)
        )
        return f"{self.what:9} {self.methods:9.2f} {self.without:9.2f} | {ratios} | {self.step:9.2f}"


def rows(size: int = 1_000, count: int = 100, *, rounds: int = 7) -> list[Row]:
    """Trees by methods, with generated code, with a debugger, and with `count` breakpoints."""
    found = []
    for what, xml in (("full", body(size)), ("reactive", body(size, "ReactiveSequence", last="Run"))):
        trees = [Tree.from_xml(document(xml), NODES) for _ in range(5)]
        methods, _, attached, results, conditions = trees
        methods.generate_code(on=False)
        attached.debug(Debugger(_never))
        nodes = results.nodes[1 :: max(1, size // count)][:count]
        places = [place_of(node, one_instance=True) for node in nodes]
        _debug(results, [Breakpoint(place, When.RETURNS, Status.FAILURE) for place in places])
        conditions.blackboard["battery"] = 80.0
        _debug(conditions, [Breakpoint(place, condition="battery < 20") for place in places])
        calls = [tree.tick_exactly_once for tree in trees]
        warm(*calls)
        times = [*race(*calls, rounds=rounds), _step_us(xml)]
        found.append(Row(what, *times))
    return found


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
        "debugger: methods, without | attached, 100 breakpoints not hit: on a result, with a condition"
        " | a tick with one stop; µs"
    )
    for row in rows():
        print(row)
