"""Adaptation of picture quality and rates to the load. Pure.

Three things adapt. Pictures for a slow client get smaller, fewer and of lower quality. For each client, the
manager reports the share of its pictures that newer ones replaced before they could be sent; each lower level
halves the bytes. Cameras draw less often on a machine that cannot draw them at their rates in real time, so
that robots are not slowed down. The server's own view gets smaller if it cannot be drawn at its rate.

A higher level is tried when nothing was lost for a while; each time that it turns out to be too high, it is
tried less often.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Generic, TypeVar

from executor.render.jpeg import BEST_QUALITY

if TYPE_CHECKING:
    from collections.abc import Sequence

T = TypeVar("T")

TOO_MUCH: Final = 0.2
FIRST_PATIENCE: Final = 6
LONGEST_PATIENCE: Final = 96


@dataclass(frozen=True)
class Level:
    """A level of quality: shares of the requested width and rate, and the JPEG quality."""

    width: float
    rate: float
    quality: int


LEVELS: Final = (
    Level(1.0, 1.0, BEST_QUALITY),
    Level(1.0, 1.0, 62),
    Level(0.75, 1.0, 60),
    Level(0.6, 0.75, 55),
    Level(0.5, 0.5, 50),
    Level(0.35, 0.35, 45),
    Level(0.25, 0.2, 40),
)


CAMERA_SHARES: Final = (1.0, 0.7, 0.5, 0.35, 0.25, 0.15)
"""The levels for cameras, as shares of their configured rates."""
TOO_SLOW: Final = 0.03

VIEW_SHARES: Final = (1.0, 0.75, 0.6, 0.5, 0.35)
"""The levels for the server's view, as shares of the requested width."""
TOO_FEW: Final = 0.15
COUNTED_S: Final = 0.5
COUNTED_PERIODS: Final = 4


class Adaptation(Generic[T]):
    """Selects one of several levels, of which the first is the best.

    Args:
        levels: the levels to choose from.
        too_much: the share of lost pictures from which the level is too high.
    """

    def __init__(self, levels: Sequence[T], too_much: float = TOO_MUCH) -> None:
        self._levels = levels
        self._too_much = too_much
        self._at = 0
        self._quiet = 0
        self._patience = FIRST_PATIENCE
        self._has_just_risen = False

    @property
    def level(self) -> T:
        """The current level."""
        return self._levels[self._at]

    def note(self, lost: float) -> None:
        """Adapts the level to the share of pictures lost since the last call, 0 to 1."""
        if lost > self._too_much:
            if self._has_just_risen:
                self._patience = min(self._patience * 2, LONGEST_PATIENCE)
            self._at = min(self._at + 1, len(self._levels) - 1)
            self._quiet, self._has_just_risen = 0, False
            return
        self._quiet += 1
        if self._quiet < self._patience:
            return
        self._quiet = 0
        if self._at:
            self._at -= 1
            self._has_just_risen = True
        else:
            self._patience, self._has_just_risen = FIRST_PATIENCE, False


class CameraRates:
    """Computes the share of their rates at which cameras draw, from the real-time factor of the world."""

    def __init__(self) -> None:
        self._adaptation = Adaptation(CAMERA_SHARES, TOO_SLOW)
        self._late = 0.0

    @property
    def share(self) -> float:
        """The share of the cameras' rates, 0 to 1."""
        return self._adaptation.level

    def note(self, real_time_factor: float, speed: float) -> None:
        """Adapts the share to the real-time factor of the last second.

        If the world is faster than real time, no picture is dropped.
        """
        late = max(0.0, 1 - real_time_factor / speed) if 0 < speed <= 1 else 0.0
        # The better of the last two seconds counts, since a single slow one may be an exception.
        self._adaptation.note(min(late, self._late))
        self._late = late


class ViewSize:
    """Computes the share of its width at which a view is drawn, from the share of pictures on time."""

    def __init__(self) -> None:
        self._adaptation = Adaptation(VIEW_SHARES, TOO_FEW)
        self._since: tuple[float, int] | None = None
        self._sent = 0

    @property
    def share(self) -> float:
        """The share of the width, 0 to 1."""
        return self._adaptation.level

    def sent(self, now_s: float, period_s: float, version: int) -> None:
        """Notes a picture of a version of the world. The version of a paused world does not change."""
        if self._since is None:
            self._since = (now_s, version)
            return
        began_s, first = self._since
        self._sent += 1
        passed_s = now_s - began_s
        if passed_s < max(COUNTED_S, COUNTED_PERIODS * period_s):
            return
        due = max(1.0, min(passed_s / period_s, version - first))
        self._adaptation.note(max(0.0, 1 - self._sent / due))
        self._since, self._sent = (now_s, version), 0
