"""IsBatteryCharging of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or, is_active
from tree_gardener.nav2.topics import Topic
from tree_gardener.ports import Port


class IsBatteryCharging(Behaviour):
    """Succeeds if the last message says that the battery is charging.

    It fails until a message is received. When it starts, it subscribes to the topic if that has changed.
    Rule: Nav2's plugins/condition/is_battery_charging_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "battery_topic": Port(str, default="/battery_status", description="Topic of the battery's state.")
    }

    def setup(self, **kwargs: Any) -> None:
        self.battery = Topic(kwargs.get("node"), "sensor_msgs", "BatteryState")
        self.is_charging = False
        self.initialise_ports()

    def initialise_ports(self) -> None:
        """Subscribes to the topic of the port."""
        self.battery.follow(input_or(self, "battery_topic", ""))

    def update(self) -> Status:
        if not is_active(self):
            self.initialise_ports()
        message = self.battery.take()
        if message is not None:
            self.is_charging = message.power_supply_status == message.POWER_SUPPLY_STATUS_CHARGING
        return Status.SUCCESS if self.is_charging else Status.FAILURE

    def shutdown(self) -> None:
        self.battery.close()
