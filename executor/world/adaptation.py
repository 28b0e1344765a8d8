"""How large, how good and how often pictures are for a client that is too slow for all of them. Pure.

The manager says for each client which share of its pictures had to be thrown away because newer ones came
before they could be sent. Each step down costs about half the bytes; a step up is tried when nothing was
lost for a while, and more rarely each time that it proved too much.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

TOO_MUCH: Final = 0.2
FIRST_PATIENCE: Final = 6
LONGEST_PATIENCE: Final = 96


@dataclass(frozen=True)
class Level:
    """A share of the width and of the rate that the client asked for, and JPEG's quality."""

    width: float
    rate: float
    quality: int


LEVELS: Final = (
    Level(1.0, 1.0, 82),
    Level(1.0, 1.0, 62),
    Level(0.75, 1.0, 60),
    Level(0.6, 0.75, 55),
    Level(0.5, 0.5, 50),
    Level(0.35, 0.35, 45),
    Level(0.25, 0.2, 40),
)


class Adaptation:
    """The level of one client."""

    def __init__(self) -> None:
        self._at = 0
        self._quiet = 0
        self._patience = FIRST_PATIENCE
        self._has_just_risen = False

    @property
    def level(self) -> Level:
        """How to draw for the client now."""
        return LEVELS[self._at]

    def note(self, lost: float) -> None:
        """Takes the share of pictures that was lost in the last report's time, 0 to 1."""
        if lost > TOO_MUCH:
            if self._has_just_risen:
                self._patience = min(self._patience * 2, LONGEST_PATIENCE)
            self._at = min(self._at + 1, len(LEVELS) - 1)
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
