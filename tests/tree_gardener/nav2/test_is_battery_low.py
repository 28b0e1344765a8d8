"""IsBatteryLow of Nav2."""

from __future__ import annotations

import pytest
from sensor_msgs.msg import BatteryState

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.is_battery_low import IsBatteryLow


@pytest.mark.parametrize(
    ("ports", "voltage", "percentage", "expected"),
    [
        ('min_battery="0.3"', 0.0, 0.25, "S"),
        ('min_battery="0.25"', 0.0, 0.25, "S"),
        ('min_battery="0.2"', 0.0, 0.25, "F"),
        ('min_battery="11" is_voltage="true"', 12.0, 0.0, "F"),
        ('min_battery="13" is_voltage="true"', 12.0, 0.0, "S"),
    ],
)
def test_percentage_or_voltage_is_compared(
    ports: str, voltage: float, percentage: float, expected: str
) -> None:
    ros = RosNode()
    trial = Trial(IsBatteryLow, ports, ros=ros)
    assert trial.tick() == "F"
    ros.publish("/battery_status", BatteryState(voltage=voltage, percentage=percentage))
    assert trial.tick() + trial.again() == expected * 2


def test_the_topic_and_the_limit_are_read_at_each_start() -> None:
    ros = RosNode()
    ports = 'battery_topic="{topic}" min_battery="0.5"'
    trial = Trial(IsBatteryLow, ports, ros=ros, topic="/one")
    trial.tick()
    trial["topic"] = "/two"
    trial.tick()
    assert ros.topics["/one"] == []
    ros.publish("/two", BatteryState(percentage=0.1))
    assert trial.tick() == "S"
    trial.tree.shutdown()
    assert ros.topics["/two"] == []
    assert Trial(IsBatteryLow, ports).tick() == "F"
