"""The rules of the decorators are sound and exact: the engine returns each predicted result, and no other."""

from __future__ import annotations

import pytest

from tests.translator.check.results.test_controls import LETTERS, SETS, observed
from translator.check.results.decorators import RULES, of_decorator
from translator.check.results.sets import ALL, YIELDS, F, R, S, names_of, set_of
from translator.tree import Node
from tree_gardener import catalog


def predicted(type_, letters, ports):
    child = set_of(LETTERS[letter] for letter in letters)
    return set(names_of(of_decorator(Node("n", type_, ports=ports), child)))


@pytest.mark.parametrize(
    ("type_", "ports"),
    [
        ("Inverter", {}),
        ("ForceSuccess", {}),
        ("ForceFailure", {}),
        ("Repeat", {"num_cycles": "2"}),
        ("Repeat", {"num_cycles": "1"}),
        ("Repeat", {"num_cycles": "0"}),
        ("Repeat", {"num_cycles": "-1"}),
        ("RetryUntilSuccessful", {"num_attempts": "2"}),
        ("RetryUntilSuccessful", {"num_attempts": "-1"}),
        ("RetryUntilSuccessful", {"num_attempts": "-2"}),
        ("KeepRunningUntilFailure", {}),
        ("RunOnce", {}),
        ("RunOnce", {"then_skip": "false"}),
        ("Precondition", {"if": "false", "else": "RUNNING"}),
        ("Precondition", {"if": "true", "else": "FAILURE"}),
        ("Timeout", {"msec": "0"}),
    ],
)
def test_each_result_is_predicted_and_found(type_, ports):
    for letters in (*SETS, "FRS", "FS", "FKRS"):
        found, foreseen = observed(type_, (letters,), ports), predicted(type_, letters, ports)
        assert found == foreseen, (type_, letters, found, foreseen)


@pytest.mark.parametrize(
    ("type_", "ports", "child", "result"),
    [
        ("LoopInt", {"queue": "1;2"}, S, S | R),
        ("LoopInt", {"queue": "1", "if_empty": "{x}"}, S, ALL),
        ("Delay", {"delay_msec": "5"}, S, S | R),
        ("Timeout", {"msec": "5"}, S, S),
        ("Timeout", {"msec": "5"}, S | R, S | R | F),
        ("Timeout", {"msec": "{t}"}, R, R | F),
        ("Repeat", {"num_cycles": "{n}"}, F, F | S),
        ("Repeat", {"num_cycles": "-1"}, S, YIELDS),
        ("Precondition", {"if": "x", "else": "{e}"}, S, ALL),
        ("WaitValueUpdate", {"entry": "{e}"}, S, S | R),
    ],
)
def test_rules_of_time_and_entries(type_, ports, child, result):
    assert of_decorator(Node("n", type_, ports=ports), child) == result


def test_other_nodes_are_unknown():
    assert of_decorator(Node("n", "Sequence"), S) is None


def test_each_decorator_of_the_catalogue_has_a_rule():
    assert set(RULES) == {type_ for type_, node in catalog.load().items() if node.kind == "decorator"}
