"""GetNextFewGoals of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial, goals, xs
from tree_gardener.nav2.get_next_few_goals import GetNextFewGoals


@pytest.mark.parametrize(("count", "expected"), [(0, []), (2, [1.0, 2.0]), (9, [1.0, 2.0, 3.0])])
def test_the_first_goals_are_written(count: int, expected: list[float]) -> None:
    ports = f'num_goals="{count}" input_goals="{{goals}}" output_goals="{{new}}"'
    trial = Trial(GetNextFewGoals, ports, goals=goals(1.0, 2.0, 3.0))
    assert trial.tick() == "S"
    assert xs(trial["new"]) == expected
    trial["goals"] = goals()
    assert trial.tick() == "F"
