"""A battery that is discharged by idling and driving. Pure; time is an argument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from executor.robots.config import Battery

_HOUR_S: Final = 3600.0
_EMPTY_VOLTAGE: Final = 0.86  # fraction of the nominal voltage
_FULL_VOLTAGE: Final = 1.10


@dataclass(frozen=True)
class BatteryReading:
    """Voltage in V, current in A (negative while discharging, as in `BatteryState`), charge in Ah."""

    voltage: float
    current: float
    charge: float
    capacity: float

    @property
    def percentage(self) -> float:
        """Charge from 0 to 1."""
        return self.charge / self.capacity


class BatteryModel:
    """Tracks the remaining charge; the voltage falls with it."""

    def __init__(self, config: Battery) -> None:
        self._config = config
        self.charge = config.capacity_ah * config.start
        self._current = config.idle_a

    @property
    def is_empty(self) -> bool:
        """Whether the battery is empty."""
        return self.charge <= 0.0

    def drain(self, effort: float, dt_s: float) -> None:
        """Discharges for `dt_s` of idling and driving; `effort` is 0 at rest and 1 at full speed."""
        self._current = self._config.idle_a + self._config.drive_a * min(1.0, max(0.0, effort))
        self.charge = max(0.0, self.charge - self._current * dt_s / _HOUR_S)

    def save(self) -> list[float]:
        """Returns the state as plain data."""
        return [self.charge, self._current]

    def restore(self, saved: list[float]) -> None:
        """Restores a state that `save` returned."""
        self.charge, self._current = saved

    def reading(self) -> BatteryReading:
        """Returns the current measurement."""
        config = self._config
        part = self.charge / config.capacity_ah
        voltage = config.voltage * (_EMPTY_VOLTAGE + (_FULL_VOLTAGE - _EMPTY_VOLTAGE) * part)
        return BatteryReading(voltage, -self._current, self.charge, config.capacity_ah)
