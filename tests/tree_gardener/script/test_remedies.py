"""The slow ways of compiled scripts: those that the code calls, each with the evaluator's errors."""

from __future__ import annotations

import pytest

from tree_gardener.blackboard import Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.script import Environment, parse, remedies
from tree_gardener.script.syntax import Assignment, Comparison, Name


def test_all_remedies_are_named() -> None:
    assert all(callable(getattr(remedies, name)) for name in remedies.NAMES)


def test_reading_and_assigning_follow_the_scope() -> None:
    environment = Environment(Blackboard(), {"RED": 5}, 3)
    name, assignment = parse("x").statements[0], parse("x := 4").statements[0]
    assert isinstance(name, Name)
    assert isinstance(assignment, Assignment)
    with pytest.raises(ScriptError, match="there is no entry 'x'"):
        remedies.read(environment, name)
    entry = remedies.target(environment, assignment)
    assert remedies.assign(environment, assignment, entry, 4) == 4
    assert remedies.read(environment, name).value == 4


def test_texts_are_compared_as_enum_constants() -> None:
    comparison = parse("x == 'RED'").statements[0]
    assert isinstance(comparison, Comparison)
    environment = Environment(Blackboard(), {"RED": 5})
    assert remedies.comparison(environment, comparison, "==", 5, "RED") is True


def test_a_condition_without_a_truth_is_an_error() -> None:
    with pytest.raises(ScriptError, match="neither 0 nor 1"):
        remedies.truth(Environment(Blackboard(), {}), parse("x"), 2)
