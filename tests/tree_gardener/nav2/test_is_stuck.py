"""IsStuck of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, odometry
from tree_gardener.nav2.is_stuck import IsStuck


def test_hard_braking_counts_from_the_third_message_on() -> None:
    ros = RosNode()
    trial = Trial(IsStuck, ros=ros)
    for time_s, speed, expected in (
        (1.0, 2.0, "F"),
        (1.1, 0.0, "F"),
        (1.2, 0.0, "F"),
        (1.3, -0.9, "F"),
        (1.4, -2.0, "S"),
        (1.4, 0.0, "S"),
        (1.5, 0.0, "F"),
    ):
        ros.publish("odom", odometry(speed, time_s))
        assert trial.tick() == expected, time_s
    trial.tree.shutdown()
    assert ros.topics["odom"] == []
