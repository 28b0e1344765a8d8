"""SpeedController of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import RosNode, Trial, odometry
from tree_gardener import TickError
from tree_gardener.nav2.speed_controller import SpeedController

PORTS = 'min_rate="1.0" max_rate="2.0" min_speed="0.0" max_speed="1.0"'


def test_the_rate_grows_with_the_speed() -> None:
    ros = RosNode()
    trial = Trial(SpeedController, PORTS, children="S", ros=ros)
    assert trial.tick() == "S"
    trial.clock.advance(0.5)  # the highest rate at first
    assert trial.again() == "S"
    trial.clock.advance(0.9)
    assert trial.again() == "R"
    trial.clock.advance(0.1)  # the robot is at rest: the lowest rate
    ros.publish("odom", odometry(0.5))
    assert trial.again() == "S"
    trial.clock.advance(1.0 / 1.5 - 0.01)
    assert trial.again() == "R"
    trial.clock.advance(0.01)
    assert trial.again() == "S"


def test_a_new_goal_ticks_the_child_at_once() -> None:
    trial = Trial(SpeedController, PORTS, children="S", goal=1)
    assert trial.tick() + trial.again() == "SR"
    trial["goal"] = 2
    assert trial.again() + trial.again() == "SR"


def test_equal_speeds_are_a_step() -> None:
    trial = Trial(SpeedController, 'min_speed="0.5" max_speed="0.5"', children="S")
    assert trial.tick() == "S"
    trial.clock.advance(1.0)
    assert trial.again() == "S"
    trial.clock.advance(9.0)  # the robot is at rest: 0.1 Hz
    assert trial.again() == "R"
    trial.clock.advance(1.0)
    assert trial.again() == "S"


def test_a_running_child_is_ticked_at_every_tick() -> None:
    trial = Trial(SpeedController, children="RRS")
    assert trial.tick() + trial.tick() + trial.tick() == "RRS"


def test_a_rate_of_zero_is_an_error() -> None:
    with pytest.raises(TickError, match="greater than 0"):
        Trial(SpeedController, 'min_rate="0.0"', children="S")
