"""IsBatteryCharging of Nav2."""

from __future__ import annotations

from sensor_msgs.msg import BatteryState

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.is_battery_charging import IsBatteryCharging


def test_the_last_message_counts() -> None:
    ros = RosNode()
    trial = Trial(IsBatteryCharging, 'battery_topic="/power"', ros=ros)
    assert trial.tick() == "F"
    charging = BatteryState(power_supply_status=BatteryState.POWER_SUPPLY_STATUS_CHARGING)
    ros.publish("/power", charging)
    assert trial.tick() + trial.again() == "SS"
    ros.publish("/power", BatteryState(power_supply_status=BatteryState.POWER_SUPPLY_STATUS_FULL))
    assert trial.again() == "F"
    trial.tree.shutdown()
    assert ros.topics["/power"] == []
