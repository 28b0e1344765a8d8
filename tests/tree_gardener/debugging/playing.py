"""Runs random trees under a debugger that stops, steps, and changes its breakpoints by random numbers."""

from __future__ import annotations

import functools
import random
from collections import Counter
from typing import TYPE_CHECKING, Any

from tests.tree_gardener.generated.both_ways import KEPT, Run, general
from tree_gardener import Status
from tree_gardener.debugging import (
    Breakpoint,
    Debugger,
    DebuggingEnded,
    Force,
    ForceError,
    Position,
    Step,
    Stop,
    When,
    place_of,
)
from tree_gardener.debugging.ahead import ahead
from tree_gardener.debugging.stepper import Event, Shape
from tree_gardener.debugging.wiring import AskingGuard

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.tree_gardener.fuzz.generate import Case
    from tree_gardener.debugging.wiring import Wiring
    from tree_gardener.node import Node

Seen = tuple[Event, int, int, str]
STATUSES = (Status.SUCCESS, Status.FAILURE, Status.RUNNING, Status.SKIPPED)


class Everything:
    """An agent that every node asks, and that notes everything: the general way, from the start.

    Attributes:
        seen: event, uid, tick and the statuses of all nodes, in order.
        foreseen: what was said to be ahead at each of them.
    """

    def __init__(self, run: Run) -> None:
        self.run = run
        self.shape = Shape.of(run.tree.nodes)
        self.seen: list[Seen] = []
        self.foreseen: list[frozenset[int]] = []

    def attach(self, wiring: Wiring) -> None:
        wiring.choose({}, everything=True)

    def before(self, node: Node) -> None:
        self.note(Event.BEFORE, node)

    def after(self, node: Node, status: Status, decided: str) -> Status:
        self.note(Event.DECIDED if decided else Event.AFTER, node)
        return status

    def forced(self, node: Node) -> Status | None:
        return None

    def may_halt(self, node: Node) -> bool:
        return True

    def halted(self, node: Node) -> None:
        if self.run.tree.is_ticking:
            self.note(Event.HALTED, node)

    def note(self, event: Event, node: Node) -> None:
        tree = self.run.tree
        self.seen.append((event, node.uid, tree.tick_number, self.run.state()))
        rest = ahead(tree.nodes, self.shape, node.uid, event)
        self.foreseen.append(frozenset(rest))


class DebuggedRun(Run):
    """A run with a player, who does something before each tick or halt."""

    def __init__(
        self, case: Case, letters: str, *, player: type[Player] | None = None, changes: bool = False
    ) -> None:
        super().__init__(case, is_generated=True, letters=letters, changes=changes)
        self.player = (player or Player)(self, case.seed)

    def tick(self, function: Callable[[], Any]) -> None:
        self.player.between_ticks()
        super().tick(function)


class Player:
    """A debugger's user who only looks, steps and continues.

    Attributes:
        stops: where the tree was held, with the statuses of all nodes.
        said: the lines of breakpoints that log.
    """

    def __init__(self, run: Run, seed: int) -> None:
        self.run = run
        self.chance = random.Random(seed)  # noqa: S311 - a reproducible case, no secret
        self.stops: list[Seen] = []
        self.said: list[str] = []
        self.debugger = Debugger(self.hold, self.said.append)
        run.tree.debug(self.debugger)
        self.debugger.set_breakpoints(self.breakpoints())

    @property
    def seen(self) -> tuple[list[Seen], list[str], list[int]]:
        """The stops, the lines, and the hits of each breakpoint that the user has seen."""
        breakpoints = self.debugger.breakpoints
        return self.stops, self.said, [breakpoints.hits(each) for each in breakpoints.all]

    def between_ticks(self) -> None:
        """Does something between two ticks."""
        kind = self.chance.random()
        if kind < 0.3:
            self.debugger.request_hold()
        elif kind < 0.4:
            self.debugger.turn_breakpoints(on=True)

    def breakpoints(self) -> list[Breakpoint]:
        """Random breakpoints of all kinds."""
        nodes, chance = self.run.tree.nodes, self.chance
        found: dict[Breakpoint, None] = {}
        for _ in range(chance.choice((0, 1, 2, 2, 5))):
            when = chance.choice(list(When))
            status = chance.choice(STATUSES) if when is When.RETURNS else None
            place = place_of(chance.choice(nodes), one_instance=chance.random() < 0.5)
            condition = chance.choice(("", "", "i0 == 1", "nothing_of_this_name"))
            hits, log = chance.choice((1, 1, 2, 3)), chance.choice(("", "", "", "i0 is {i0}"))
            found[Breakpoint(place, when, status, condition, hits, log, chance.random() < 0.9)] = None
        return list(found)

    def hold(self, stop: Stop) -> None:
        """Looks at the stop, and continues in some way."""
        tree, chance, debugger = self.run.tree, self.chance, self.debugger
        node = tree.nodes[stop.uid - 1]
        assert (stop.path, stop.tick) == (node.path, tree.tick_number)
        assert stop.lead[0] == 1
        assert stop.lead[-1] == stop.uid
        assert all(tree.nodes[b - 1].parent.uid == a for a, b in zip(stop.lead, stop.lead[1:], strict=False))
        self.stops.append((stop.event, stop.uid, stop.tick, self.run.state()))
        self.command(stop)
        step = self.step()
        if step is Step.HOLD:
            debugger.request_hold()
        else:
            debugger.resume(step, chance.choice(tree.nodes).uid)

    def step(self) -> Step:
        """The way to continue."""
        return self.chance.choice((*Step, Step.INTO, Step.CONTINUE))

    def command(self, stop: Stop) -> None:
        """Does something else at the stop, without an effect on the run."""
        chance, debugger = self.chance, self.debugger
        if chance.random() < 0.3:
            debugger.set_breakpoints(self.breakpoints())
        if chance.random() < 0.1:
            debugger.turn_breakpoints(on=chance.random() < 0.5)


class Waiter(Player):
    """A debugger's user who leaves breakpoints at many nodes, most of which are not hit."""

    def between_ticks(self) -> None:
        pass

    def breakpoints(self) -> list[Breakpoint]:
        nodes, chance = self.run.tree.nodes, self.chance
        found = []
        stop = 99 if chance.random() < 0.1 else 0  # the condition that cannot be tested
        for node in nodes:
            if chance.random() < 0.5:
                when = chance.choice(list(When))
                status = chance.choice(STATUSES) if when is When.RETURNS else None
                condition = chance.choice(("i0 == 1", "i1 > 2", "i0 < 0", "", "nothing_of_this_name"[:stop]))
                hits, log = chance.choice((1, 2, 5)), "i0 is {i0}" if chance.random() < 0.7 else ""
                found.append(Breakpoint(place_of(node), when, status, condition, hits, log))
        return found

    def command(self, stop: Stop) -> None:
        pass

    def step(self) -> Step:
        return self.chance.choice((Step.CONTINUE, Step.CONTINUE, Step.INTO, Step.OVER, Step.OUT))


@functools.lru_cache(KEPT)
def record(case: Case, letters: str, *, changes: bool = False) -> tuple[list[Any], Everything]:
    """Runs a case by the nodes' own methods under an agent that every node asks."""
    run = Run(case, is_generated=False, letters=letters, changes=changes)
    agent = Everything(run)
    run.tree.debug(agent)
    return run.run(), agent


def compare(
    case: Case, letters: str, *, player: type[Player] = Player, changes: bool = False, is_exact: bool = False
) -> int:
    """Compares a run without a debugger, one that asks everywhere, and one with stops; counts the stops.

    Raises:
        AssertionError: the runs differ.
    """
    plain = general(case, letters, changes=changes)
    recorded, agent = record(case, letters, changes=changes)
    _same(case, plain, recorded)
    run = DebuggedRun(case, letters, player=player, changes=changes)
    _same(case, plain, run.run())
    rest = iter(agent.seen)
    for stop in run.player.stops:
        assert any(stop == seen for seen in rest), f"seed {case.seed}: no node was at {stop}\n{case.xml()}"
    if is_exact:
        by_methods = DebuggedRun(case, letters, player=player, changes=changes)
        by_methods.tree.generate_code(on=False)
        by_methods.run()
        assert run.player.seen == by_methods.player.seen, f"seed {case.seed}:\n{case.xml()}"
    if case.mode == "exactly_once" and "H" not in letters:
        _foreseen(case, agent)
    run.tree.debug(None)
    assert all(type(node.guard).__name__ != "AskingGuard" for node in run.tree.nodes)
    return len(run.player.stops)


def _same(case: Case, expected: list[Any], found: list[Any]) -> None:
    for index, (wanted, got) in enumerate(zip(expected, found, strict=False)):
        assert wanted == got, (
            f"seed {case.seed}, entry {index}:\n{case.xml()}\nwithout {wanted}\nwith    {got}"
        )
    assert len(expected) == len(found)


def _foreseen(case: Case, agent: Everything) -> None:
    """Checks that nothing was ticked that was not said to be ahead, at any event before it in the tick."""
    possible: frozenset[int] | None = None
    current = 0
    for (event, uid, tick, _), rest in zip(agent.seen, agent.foreseen, strict=True):
        if tick != current or possible is None:
            current, possible = tick, rest
        if event is Event.BEFORE:
            assert uid in possible, f"seed {case.seed}: {uid} was ticked unforeseen\n{case.xml()}"
        possible &= rest


COMMANDS = (
    *("set_breakpoints", "turn_breakpoints", "resume", "request_hold", "force", "freeze", "after"),
    *("skip_to", "skip_to refused", "run_alone", "release", "release all", "end"),
)


class Commander(Player):
    """A debugger's user who gives any command at every stop.

    Attributes:
        given: the commands that were given.
    """

    def __init__(self, run: Run, seed: int) -> None:
        super().__init__(run, seed)
        self.given = Counter[str]()
        self.log = run.tree.log_results()

    def between_ticks(self) -> None:
        self.debugger.request_hold()

    def command(self, stop: Stop) -> None:
        chance, debugger, tree = self.chance, self.debugger, self.run.tree
        what = chance.choice(COMMANDS[:-1] if chance.random() < 0.9 else COMMANDS)
        uid = chance.choice((stop.uid, chance.choice(tree.nodes).uid))
        if what == "set_breakpoints":
            debugger.set_breakpoints(self.breakpoints())
        elif what == "turn_breakpoints":
            debugger.turn_breakpoints(on=chance.random() < 0.7)
        elif what in ("resume", "request_hold"):
            pass  # at every stop
        elif what == "force":
            result = chance.choice((Status.SUCCESS, Status.FAILURE, Status.SKIPPED))
            self.force(Force(uid, result, once=chance.random() < 0.7))
        elif what == "after":
            result = chance.choice((Status.SUCCESS, Status.FAILURE, Status.SKIPPED))
            self.force(Force(uid, result, once=chance.random() < 0.7, position=Position.AFTER))
        elif what == "freeze":
            self.force(Force(uid, Status.RUNNING))
        elif what.startswith("skip_to"):
            what = self.skip(uid)
        elif what == "run_alone":
            self.run_alone(uid)
        elif what == "release":
            debugger.release(uid)
            assert uid not in [force.uid for force in debugger.forces]
        elif what == "release all":
            debugger.release(None)
            assert debugger.forces == []
        self.given[what] += 1
        if what == "end":
            raise DebuggingEnded

    def run_alone(self, uid: int) -> None:
        """Makes a node run alone; the root does already."""
        if uid > 1:
            self.debugger.run_alone(uid)
            assert self.debugger.alone == uid

    def force(self, force: Force) -> None:
        """Forces a result, which is listed then."""
        self.debugger.force(force)
        assert force in self.debugger.forces

    def skip(self, uid: int) -> str:
        """Skips to a node, or is refused; returns which."""
        try:
            self.debugger.skip_to(uid)
        except ForceError:
            return "skip_to refused"
        return "skip_to"


def play(case: Case, letters: str) -> Counter[str]:
    """Runs a case with any command at every stop; afterwards the tree is as one that was never debugged.

    Raises:
        AssertionError: something of the debugger is left.
    """
    run = DebuggedRun(case, letters)
    run.player = player = Commander(run, case.seed)
    for _ in range(case.ticks):
        try:
            run.tick(run.tree.tick_exactly_once)
        except DebuggingEnded:
            run.tree.halt()
    run.tree.debug(None)
    run.tree.halt()
    assert {node.status for node in run.tree.nodes} == {Status.IDLE}
    assert not any(isinstance(node.guard, AskingGuard) for node in run.tree.nodes)
    return player.given
