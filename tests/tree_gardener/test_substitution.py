"""Nodes that are replaced for tests."""

from __future__ import annotations

from typing import Any

import pytest

from tests.tree_gardener.trees import load, subtree
from tree_gardener import Status
from tree_gardener.substitution import RuleError, parse_rules


def test_substitution_rules_replace_nodes() -> None:
    rules = {
        "TestNodeConfigs": {"ko": {"return_status": "FAILURE", "failure_script": "why := 'test'"}},
        "SubstitutionRules": {"Arm::2/*": "ko", "third": "AlwaysFailure"},
    }
    tree = load(
        '<Fallback><SubTree ID="Arm"/><Succeeding name="third"/></Fallback>',
        subtree("Arm", "<Succeeding/>"),
        substitutions=rules,
    )
    assert tree.tick_exactly_once() is Status.FAILURE
    assert tree.blackboard.scope("Arm::2")["why"] == "test"


def test_rules_are_read_from_text_or_an_object() -> None:
    [rule] = parse_rules('{"SubstitutionRules": {"Arm/*": "AlwaysSuccess"}}')
    assert (rule.pattern, rule.type, rule.config) == ("Arm/*", "AlwaysSuccess", None)
    assert rule.matches("x", "Move", "Arm/x")
    assert not rule.matches("x", "Move", "Leg/x")


@pytest.mark.parametrize(
    ("rules", "message"),
    [
        ("{", "are not JSON"),
        ("[]", "are not an object"),
        ({"TestNodeConfigs": {"t": {}}}, "has no return_status"),
        ({"TestNodeConfigs": {"t": {"return_status": "MAYBE"}}}, "MAYBE"),
    ],
)
def test_rules_that_make_no_sense_are_refused(rules: Any, message: str) -> None:
    with pytest.raises(RuleError, match=message):
        parse_rules(rules)
