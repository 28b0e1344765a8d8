"""Ports that may be missing."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.goal_updated import GoalUpdated
from tree_gardener.nav2.reading import goals_of, input_or, input_or_entry, is_active, now


def test_a_port_then_the_entry_then_the_other_value() -> None:
    trial = Trial(GoalUpdated, 'goal="{here}"', goal=1, goals=2)
    node = trial.tree.nodes[0].behaviour
    assert goals_of(node) == (1, 2)
    trial["here"] = 3
    assert goals_of(node) == (3, 2)
    assert input_or(node, "goals", 5) == 5
    assert input_or_entry(node, "nothing", 6) == 6
    trial.clock.advance(2.0)
    assert now(node) == 2.0
    assert not is_active(node)
