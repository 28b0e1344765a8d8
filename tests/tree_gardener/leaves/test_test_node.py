"""TestNode, which stands in for others."""

from __future__ import annotations

from tests.tree_gardener.trees import load
from tree_gardener import ManualClock, Status
from tree_gardener.leaves.test_node import TestConfig, TestNode


def test_a_test_node_takes_its_time_and_its_status_from_a_script() -> None:
    config = '{"t": {"return_status_script": "x", "async_delay": 100}}'
    rules = f'{{"TestNodeConfigs": {config}, "SubstitutionRules": {{"a": "t"}}}}'
    clock = ManualClock()
    tree = load('<Succeeding name="a"/>', substitutions=rules, clock=clock)
    tree.blackboard["x"] = "SKIPPED"
    assert tree.tick_exactly_once() is Status.RUNNING
    clock.advance(0.1)
    assert tree.tick_exactly_once() is Status.SKIPPED


def test_without_a_config_it_succeeds() -> None:
    assert TestConfig().return_status is Status.SUCCESS
    assert not TestNode.__test__
