"""A differential drive: computes wheel rates from a target twist, and odometry from wheel angles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from executor.world.geometry.transforms import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

    from executor.robots.config import Drive


Covariance = tuple[float, float, float, float, float, float]


class Odometry(NamedTuple):
    """Pose in the odom frame in m and rad, and twist in the robot's frame, both as the wheels measure them.

    `covariance` holds six values of the covariance of the pose: xx, xy, x·yaw, yy, y·yaw and yaw·yaw.
    """

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    linear: float = 0.0
    angular: float = 0.0
    covariance: Covariance = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class DriveState(NamedTuple):
    """The state of the drive, for saving a world."""

    wanted: tuple[float, float] = (0.0, 0.0)
    commanded_s: float = -math.inf
    linear: float = 0.0
    angular: float = 0.0
    wheel_angles: tuple[float, float] | None = None
    odometry: Odometry = Odometry()


def drive_state(plain: Sequence[Any]) -> DriveState:
    """Returns a state from plain data: its fields, with lists in place of tuples."""
    wanted, commanded_s, linear, angular, angles, (x, y, yaw, forward, turning, covariance) = plain
    xx, xy, xt, yy, yt, tt = covariance
    odometry = Odometry(x, y, yaw, forward, turning, (xx, xy, xt, yy, yt, tt))
    turned = None if angles is None else (angles[0], angles[1])
    return DriveState((wanted[0], wanted[1]), commanded_s, linear, angular, turned, odometry)


class DifferentialDrive:
    """Computes wheel rates from target twists, within the limits of the drive.

    Stops the robot without commands.
    """

    def __init__(self, config: Drive, noise: np.random.Generator | None = None) -> None:
        self._config = config
        self._noise = noise
        self.state = DriveState()

    def command(self, linear: float, angular: float, now_s: float) -> bool:
        """Sets the target twist in m/s and rad/s; returns whether it is valid (finite)."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            return False
        limit = self._config
        wanted = (_clamp(linear, limit.max_linear), _clamp(angular, limit.max_angular))
        self.state = self.state._replace(wanted=wanted, commanded_s=now_s)
        return True

    def wheel_rates(self, now_s: float, dt_s: float) -> tuple[float, float]:
        """Returns the rates of the left and right wheels in rad/s for the next `dt_s`."""
        state, limit = self.state, self._config
        timed_out = now_s - state.commanded_s > limit.timeout_s
        linear, angular = (0.0, 0.0) if timed_out else state.wanted
        linear = _approach(state.linear, linear, limit.linear_acceleration * dt_s)
        angular = _approach(state.angular, angular, limit.angular_acceleration * dt_s)
        self.state = state._replace(linear=linear, angular=angular)
        half_track = limit.track * limit.turn_factor / 2
        return (
            (linear - angular * half_track) / limit.wheel_radius,
            (linear + angular * half_track) / limit.wheel_radius,
        )

    def observe(self, left: float, right: float, dt_s: float) -> Odometry:
        """Receives the wheels' angles in rad, `dt_s` after the last ones, and returns the new odometry."""
        last, old, limit = self.state.wheel_angles, self.state.odometry, self._config
        if last is None or dt_s <= 0:
            self.state = self.state._replace(wheel_angles=(left, right))
            return old
        ways = (left - last[0]) * limit.wheel_radius, (right - last[1]) * limit.wheel_radius
        moved, turned = self._motion(*ways)
        rates = moved / dt_s, turned / dt_s  # the twist is exact; only its integral drifts
        moved, turned = self._motion(*map(self._believed, ways))
        middle = old.yaw + turned / 2
        # The chord of an arc, not its length: exact for constant rates.
        chord = moved * (math.sin(turned / 2) / (turned / 2) if abs(turned) > 1e-9 else 1.0)
        odometry = Odometry(
            old.x + chord * math.cos(middle),
            old.y + chord * math.sin(middle),
            wrap(old.yaw + turned),
            *rates,
            self._grown(old.covariance, ways, moved, middle),
        )
        self.state = self.state._replace(wheel_angles=(left, right), odometry=odometry)
        return odometry

    def _motion(self, left: float, right: float) -> tuple[float, float]:
        limit = self._config
        return (left + right) / 2, (right - left) / (limit.track * limit.turn_factor)

    def _grown(self, old: Covariance, ways: tuple[float, float], moved: float, middle: float) -> Covariance:
        """Returns the covariance after another distance: J P Jᵀ + G Q Gᵀ.

        J is the Jacobian of the new pose with respect to the old one, G that with respect to the distances of
        the wheels; Q = slip_noise² · diag(|left|, |right|), which is the noise that `_believed` adds. See
        Siegwart and Nourbakhsh, Introduction to Autonomous Mobile Robots, 5.2.4, for the error of the
        odometry of a differential drive.
        """
        limit = self._config
        if limit.slip_noise <= 0:
            return old
        xx, xy, xt, yy, yt, tt = old
        cosine, sine = math.cos(middle), math.sin(middle)
        a, b = -moved * sine, moved * cosine  # J: x changes by a, y by b for each rad of yaw
        xx, xy, yy = (
            xx + 2 * a * xt + a * a * tt,
            xy + a * yt + b * xt + a * b * tt,
            yy + 2 * b * yt + b * b * tt,
        )
        xt, yt = xt + a * tt, yt + b * tt
        width = limit.track * limit.turn_factor
        for way, side in zip(ways, (-1.0, 1.0), strict=True):
            turn = side / width
            gx, gy = cosine / 2 + a * turn / 2, sine / 2 + b * turn / 2
            q = limit.slip_noise**2 * abs(way)
            xx, xy, xt = xx + q * gx * gx, xy + q * gx * gy, xt + q * gx * turn
            yy, yt, tt = yy + q * gy * gy, yt + q * gy * turn, tt + q * turn * turn
        return xx, xy, xt, yy, yt, tt

    def _believed(self, way: float) -> float:
        """Returns the distance that odometry measures for a wheel.

        Its error is a random walk along the true distance.
        """
        if self._noise is None or self._config.slip_noise <= 0:
            return way
        return way + self._config.slip_noise * math.sqrt(abs(way)) * float(self._noise.normal())


def _clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))


def _approach(value: float, wanted: float, step: float) -> float:
    return min(wanted, value + step) if wanted > value else max(wanted, value - step)
