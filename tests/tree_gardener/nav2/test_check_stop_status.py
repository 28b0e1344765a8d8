"""CheckStopStatus of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, odometry
from tree_gardener.nav2.check_stop_status import CheckStopStatus


def test_it_runs_until_the_robot_was_slow_for_long_enough() -> None:
    ros = RosNode()
    trial = Trial(CheckStopStatus, 'velocity_threshold="0.1" duration_stopped="500"', ros=ros)
    ros.publish("odom", odometry(-0.2, 1.0))
    assert trial.tick() == "F"
    trial.clock.advance(1.0)
    ros.publish("odom", odometry(0.05, 1.0))
    assert trial.tick() == "R"
    trial.clock.advance(0.5)
    assert trial.tick() == "R"
    trial.clock.advance(0.01)
    assert trial.tick() == "S"
    assert trial.tick() == "S"  # the message is still of the same time


def test_moving_starts_the_time_again_and_a_halt_does_not() -> None:
    ros = RosNode()
    trial = Trial(CheckStopStatus, ros=ros)
    assert trial.tick() == "R"  # no odometry counts as stopped
    trial.clock.advance(0.9)
    trial.tree.halt()
    assert trial.tick() == "R"
    ros.publish("odom", odometry(1.0, 0.9))
    assert trial.tick() == "F"
    trial.tree.shutdown()
    assert ros.topics["odom"] == []
