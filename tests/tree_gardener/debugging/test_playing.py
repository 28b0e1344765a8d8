"""A run with a debugger that only looks, steps and continues equals the run without it."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import pytest

from tests.budget import count, seeds
from tests.tree_gardener.debugging import playing
from tests.tree_gardener.generated.both_ways import RARE, USUAL, cases, loadable
from tree_gardener import Status, Tree
from tree_gardener.conformance import cases as cases_module
from tree_gardener.conformance import run_file
from tree_gardener.debugging import Breakpoint, Debugger, Stop, When, place_of
from tree_gardener.debugging.forces import Forces
from tree_gardener.debugging.wiring import Wiring
from tree_gardener.generated import generation
from tree_gardener.generated.recovery import Recovery

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.tree_gardener.fuzz.generate import Case
    from tree_gardener.generated.parts import Part
    from tree_gardener.node import Node

CASES = Path(__file__).parents[2] / "conformance"
CORPUS = ("focused.jsonl", "throws.jsonl", "timed.jsonl", "added.jsonl", "random.jsonl")


@pytest.mark.timeout(3600)
@pytest.mark.parametrize("letters", [USUAL, RARE])
def test_stops_change_nothing(letters: str) -> None:
    today = seeds("debugger_continues_trees")
    stops = sum(playing.compare(case, letters) for case in loadable(today))
    assert stops >= 5 * len(today)


@pytest.mark.timeout(3600)
@pytest.mark.parametrize(("letters", "changes"), [(USUAL, True), (RARE, False)])
def test_breakpoints_in_generated_code_change_nothing_and_stop_where_the_methods_do(
    letters: str, *, changes: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = _generated_from_the_first_tick(monkeypatch)
    today = seeds("debugger_continues_trees")
    stops = sum(
        playing.compare(case, letters, player=playing.Waiter, changes=changes, is_exact=True)
        for case in loadable(today)
    )
    assert stops >= len(today) // 2
    assert asked[True] + asked[False] >= len(today) // 10


def _generated_from_the_first_tick(monkeypatch: pytest.MonkeyPatch) -> Counter[bool]:
    """Generates code before the first tick already; counts what it asks, and whether it was left then."""
    monkeypatch.setattr(generation, "WARM_TICKS", -1)
    monkeypatch.setattr(generation, "BUDGET_S", math.inf)
    asked = Counter[bool]()
    own = Wiring.asking_before

    def asking_before(wiring: Wiring, node: Node) -> Callable[[], bool]:
        ask = own(wiring, node)

        def asks() -> bool:
            is_left = ask()
            asked[is_left] += 1
            return is_left

        return asks

    left = Recovery.tested

    def tested(recovery: Recovery, node: Any, part: Part, letter: str) -> Status | None:
        asked[True] += 1
        return left(recovery, node, part, letter)

    monkeypatch.setattr(Wiring, "asking_before", asking_before)
    monkeypatch.setattr(Recovery, "tested", tested)
    return asked


@pytest.mark.timeout(1800)
@pytest.mark.parametrize("name", CORPUS[: count("debugger_corpus_files")])
def test_the_corpus_runs_the_same_with_a_stop_at_every_node(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cases_module, "Tree", Stopped)
    Stopped.stops = 0
    assert [outcome for outcome in run_file(CASES / name) if not outcome.passed] == []
    assert Stopped.stops > 100


class Stopped(Tree):
    """A tree with breakpoints before and after every node, at which it continues.

    Attributes:
        stops: how often all such trees were held.
    """

    stops: ClassVar[int] = 0

    @classmethod
    def from_xml(cls, *args: Any, **kwargs: Any) -> Tree:
        tree = super().from_xml(*args, **kwargs)
        debugger = Debugger(cls.hold)
        tree.debug(debugger)
        places = [place_of(node, one_instance=True) for node in tree.nodes]
        debugger.set_breakpoints(
            [Breakpoint(place, when) for place in places for when in (When.BEFORE, When.AFTER, When.HALTED)]
        )
        return tree

    @classmethod
    def hold(cls, _stop: Stop) -> None:
        cls.stops += 1


@pytest.mark.timeout(3600)
def test_every_command_can_be_given_at_every_stop() -> None:
    commands = Counter[str]()
    for case in loadable(seeds("debugger_commands_trees")):
        commands += playing.play(case, USUAL)
    assert set(commands) == {*playing.COMMANDS}


def test_a_difference_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Forces, "before", lambda forces, node: Status.FAILURE if node.uid == 3 else None)
    found = cases(1, 20)
    with pytest.raises(AssertionError, match="without"):
        _compare_all(found)


def _compare_all(found: list[Case]) -> None:
    for case in found:
        playing.compare(case, USUAL)
