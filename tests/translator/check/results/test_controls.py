"""The rules of the control nodes are exact: the engine returns each predicted result, and no other."""

from __future__ import annotations

import itertools
import random

import pytest

from tests.translator.check.results.engine import leaf_class
from translator.check.results.controls import LEAST, RULES, of_control, rested, threshold
from translator.check.results.sets import ALL, F, K, S, names_of, set_of
from translator.tree import Node
from tree_gardener import TickError, Tree, catalog

LETTERS = {"S": "SUCCESS", "F": "FAILURE", "R": "RUNNING", "K": "SKIPPED"}
SETS = ("S", "F", "SF", "RS", "FR", "SK", "K")
RUNS = 12
TICKS = 7


def observed(type_, children, ports):
    """The results that the engine returns for random scripts of these letters."""
    rng = random.Random(type_ + "".join(children) + str(ports))  # noqa: S311 - repeatable
    found = set()
    attributes = "".join(f' {name}="{value}"' for name, value in ports.items())
    classes = {f"Leaf_{letters}": leaf_class(f"Leaf_{letters}") for letters in children}
    for _ in range(RUNS):
        rows = "".join(
            f'<Leaf_{letters} name="x{index}.{"".join(rng.choice(letters) for _ in range(TICKS))}"/>'
            for index, letters in enumerate(children)
        )
        xml = (
            '<root BTCPP_format="4"><BehaviorTree ID="A">'
            f"<{type_}{attributes}>{rows}</{type_}></BehaviorTree></root>"
        )
        tree = Tree.from_xml(xml, classes)
        log = tree.log_results()
        for _ in range(TICKS):
            try:
                tree.tick_exactly_once()
            except TickError:
                break
        found |= {status.name for uid, status in log if uid == 1}
    return found


def predicted(type_, children, ports):
    sets = [set_of(LETTERS[letter] for letter in letters) for letters in children]
    return set(names_of(of_control(Node("n", type_, ports=ports), sets)))


EXACT = ("Sequence", "AsyncSequence", "Fallback", "AsyncFallback", "ReactiveSequence", "ReactiveFallback")


@pytest.mark.parametrize("type_", [*EXACT, "IfThenElse", "WhileDoElse", "TryCatch", "ParallelAll"])
def test_two_children(type_):
    for children in itertools.product(SETS, repeat=2):
        found, foreseen = observed(type_, children, {}), predicted(type_, children, {})
        assert found <= foreseen, (type_, children, found, foreseen)
        assert found == foreseen, (type_, children, found, foreseen)


@pytest.mark.parametrize(
    ("type_", "ports"),
    [
        ("Parallel", {"success_count": "1", "failure_count": "2"}),
        ("Parallel", {"success_count": "2", "failure_count": "-1"}),
        ("Parallel", {}),
        ("Parallel", {"success_count": "0"}),
        ("ParallelAll", {"max_failures": "0"}),
        ("ParallelAll", {"max_failures": "-1"}),
        ("IfThenElse", {}),
        ("WhileDoElse", {}),
        ("Sequence", {}),
        ("SequenceWithMemory", {}),
        ("Switch2", {"variable": "1", "case_1": "1", "case_2": "2"}),
    ],
)
def test_three_children_return_nothing_else(type_, ports):
    for children in itertools.product(("S", "SF", "FR", "SK"), repeat=3):
        found, foreseen = observed(type_, children, ports), predicted(type_, children, ports)
        assert found <= foreseen, (type_, children, found, foreseen)


def test_what_is_not_known():
    assert of_control(Node("n", "Inverter"), [S]) is None
    assert of_control(Node("n", "IfThenElse"), [S]) == ALL
    assert of_control(Node("n", "Parallel", ports={"success_count": "{n}"}), [S, S]) == S | F
    assert set(LEAST) <= set(RULES)


def test_thresholds_and_rests():
    assert [threshold(value, 3) for value in (2, 0, -1, -9)] == [2, 0, 3, 0]
    assert rested([S | K, S | F], S, F) == S | K
    assert rested([S, S | F], S, F) == 0


def test_each_control_node_of_the_catalogue_has_a_rule():
    assert set(RULES) == {type_ for type_, node in catalog.load().items() if node.kind == "control"}
