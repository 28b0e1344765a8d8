"""SpeedController of Nav2."""

from typing import Any

from tree_gardener import DecoratorNode, Port, Status
from tree_gardener.nav2.reading import goals_of, input_or
from tree_gardener.nav2.topics import Odometer


class SpeedController(DecoratorNode):
    """Ticks its child at a rate that grows with the robot's speed, from `min_rate` to `max_rate`.

    The child is ticked immediately when the node starts or the goal changes, and at every tick while it is
    RUNNING; in between the node is RUNNING. After each period the rate is set by the smoothed odometry:
    `min_rate` at `min_speed` and below, `max_rate` at `max_speed` and above, linear between. A rate of zero
    or less is an error. Rule: Nav2's plugins/decorator/speed_controller.cpp.
    """

    INPUT_PORTS = {
        "min_rate": Port(float, default=0.1, description="The lowest rate, in Hz."),
        "max_rate": Port(float, default=1.0, description="The highest rate, in Hz."),
        "min_speed": Port(float, default=0.0, description="The speed of the lowest rate, in m/s."),
        "max_speed": Port(float, default=0.5, description="The speed of the highest rate, in m/s."),
        "goal": Port(description="The goal; the entry 'goal' if it is not given."),
        "goals": Port(description="The goals; the entry 'goals' if they are not given."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.min_rate: float = input_or(self, "min_rate", 0.1)
        self.max_rate: float = input_or(self, "max_rate", 1.0)
        self.min_speed: float = input_or(self, "min_speed", 0.0)
        self.max_speed: float = input_or(self, "max_speed", 0.5)
        if self.min_rate <= 0.0 or self.max_rate <= 0.0:
            raise ValueError("min_rate and max_rate must be greater than 0")
        self.odometer = Odometer(kwargs.get("node"))
        self.goals: tuple[Any, Any] = (None, None)
        self.period_s = self.start_s = 0.0
        self.is_first = False

    def update(self) -> Status:
        if self.status is Status.IDLE:
            self.goals = goals_of(self, self.goals)
            self.begin()
        goals = goals_of(self)
        if goals != self.goals:
            self.goals = goals
            self.begin()
        self.mark_running()
        # A tolerance, because seconds in floats do not add up.
        is_due = self.now() - self.start_s >= self.period_s - 1e-9
        if not (self.is_first or is_due or self.child_status() is Status.RUNNING):
            return Status.RUNNING
        self.is_first = False
        if is_due:
            self.period_s = 1.0 / self.rate()
            self.start_s = self.now()
        return self.tick_child()

    def begin(self) -> None:
        """Starts the time, at the highest rate."""
        self.period_s = 1.0 / self.max_rate
        self.start_s = self.now()
        self.is_first = True

    def rate(self) -> float:
        """Returns the rate for the current speed."""
        above = self.odometer.speed() - self.min_speed
        range_ = self.max_speed - self.min_speed
        if range_ == 0.0:
            return self.max_rate if above >= 0.0 else self.min_rate
        rate = above / range_ * (self.max_rate - self.min_rate) + self.min_rate
        return max(min(rate, self.max_rate), self.min_rate)

    def shutdown(self) -> None:
        self.odometer.close()
