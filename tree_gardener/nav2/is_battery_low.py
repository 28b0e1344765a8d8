"""IsBatteryLow of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or, is_active
from tree_gardener.nav2.topics import Topic
from tree_gardener.ports import Port


class IsBatteryLow(Behaviour):
    """Succeeds if the last message says that the battery is at or below `min_battery`.

    It compares the percentage, or with `is_voltage` the voltage. It fails until a message is received. The
    ports are read when it starts; it then subscribes to the topic if that has changed. Rule: Nav2's
    plugins/condition/is_battery_low_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "min_battery": Port(float, description="The least percentage (0..1) or voltage."),
        "battery_topic": Port(str, default="/battery_status", description="Topic of the battery's state."),
        "is_voltage": Port(bool, default=False, description="Whether the voltage is compared."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.battery = Topic(kwargs.get("node"), "sensor_msgs", "BatteryState")
        self.min_battery = 0.0
        self.is_voltage = False
        self.is_low = False
        self.initialise_ports()

    def initialise_ports(self) -> None:
        """Reads the ports, and subscribes to the topic."""
        self.min_battery = input_or(self, "min_battery", self.min_battery)
        self.is_voltage = input_or(self, "is_voltage", self.is_voltage)
        self.battery.follow(input_or(self, "battery_topic", ""))

    def update(self) -> Status:
        if not is_active(self):
            self.initialise_ports()
        message = self.battery.take()
        if message is not None:
            charge = message.voltage if self.is_voltage else message.percentage
            self.is_low = charge <= self.min_battery
        return Status.SUCCESS if self.is_low else Status.FAILURE

    def shutdown(self) -> None:
        self.battery.close()
