import pytest

from executor.robots import Battery
from executor.world.sensing.battery import BatteryModel


def test_it_empties_by_idling_and_more_by_driving() -> None:
    battery = BatteryModel(Battery(kind="battery", capacity_ah=2.0, idle_a=0.5, drive_a=1.5))
    full = battery.reading()
    assert full.percentage == 1.0
    battery.drain(0.0, 3600)
    assert battery.reading().charge == pytest.approx(1.5)
    battery.drain(1.0, 1800)
    half = battery.reading()
    assert half.charge == pytest.approx(0.5)
    assert half.current == pytest.approx(-2.0)
    assert half.voltage < full.voltage
    battery.drain(5.0, 3600)  # more than the capacity
    assert battery.is_empty
    assert battery.reading().percentage == 0.0
