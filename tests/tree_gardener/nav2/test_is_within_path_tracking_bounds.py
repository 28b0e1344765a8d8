"""IsWithinPathTrackingBounds of Nav2."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.is_within_path_tracking_bounds import IsWithinPathTrackingBounds

PORTS = 'max_error_left="1.0" max_error_right="-0.5" max_error_heading="0.2" tracking_feedback="{feedback}"'


@pytest.mark.parametrize(
    ("error", "heading", "expected"),
    [(1.0, 0.0, "S"), (1.1, 0.0, "F"), (-0.5, 0.0, "S"), (-0.6, 0.0, "F"), (0.0, -0.2, "S"), (0.0, 0.3, "F")],
)
def test_the_sides_and_the_heading_have_bounds_of_their_own(
    error: float, heading: float, expected: str
) -> None:
    feedback = SimpleNamespace(position_tracking_error=error, heading_tracking_error=heading)
    assert Trial(IsWithinPathTrackingBounds, PORTS, feedback=feedback).tick() == expected


def test_without_feedback_it_succeeds() -> None:
    assert Trial(IsWithinPathTrackingBounds, PORTS).tick() == "S"
