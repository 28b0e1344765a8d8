"""Which snapshots of a run are kept: so many that going back takes a moment, within bounds.

The cost of going back to a moment is the work between the snapshot before it and the moment. Snapshots are
made close to each other; as they grow old, some between them are dropped.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["CEILING_BYTES", "MOST", "MOST_TIPS", "Kept", "surplus"]

MOST: Final = 40
MOST_TIPS: Final = 4
CEILING_BYTES: Final = 256 << 20
RECENT_S: Final = 60.0
LONG_S: Final = 600.0
_GAPS: Final = {False: (0.5, 4.0), True: (1.5, 9.0)}
"""The work in s between two snapshots, in the last minute and before, without and with a camera."""


@dataclass(frozen=True)
class Kept:
    """A snapshot.

    Attributes:
        key: the number of the process that made it, and its number there.
        run: where it belongs: only snapshots of one run have gaps between them.
        t: the simulated time in s.
        cost_s: the work in s from the begin of the run up to it.
        size_bytes: the memory that it has for itself.
        is_tip: whether it is the present of a branch, which is kept beside the ring.
    """

    key: tuple[int, int]
    run: int
    t: float
    cost_s: float
    size_bytes: int = 0
    is_tip: bool = False


def surplus(
    kept: Sequence[Kept], *, draws: bool = False, ceiling_bytes: int = CEILING_BYTES, most: int = MOST
) -> list[Kept]:
    """Returns the snapshots to drop, of those of all runs; those of a run come in their order."""
    tips = [each for each in kept if each.is_tip]
    dropped = tips[: max(0, len(tips) - MOST_TIPS)]
    ring = [each for each in kept if not each.is_tip]
    for run in dict.fromkeys(each.run for each in ring):
        dropped += _too_close([each for each in ring if each.run == run], draws=draws)
    left = [each for each in ring if each not in dropped]
    size_bytes = sum(each.size_bytes for each in left)
    while left and (len(left) > most or size_bytes > ceiling_bytes or not ceiling_bytes):
        least = _least(left, draws=draws)
        left.remove(least)
        size_bytes -= least.size_bytes
        dropped.append(least)
    return dropped


def _too_close(run: Sequence[Kept], *, draws: bool) -> list[Kept]:
    """Returns the snapshots of a run without which going back is quick, too; the first and last stay."""
    dropped = []
    before = 0
    for at in range(1, len(run) - 1):
        if _gap(run[before], run[at + 1]) <= _allowed(run[at + 1], run[-1], draws=draws):
            dropped.append(run[at])
        else:
            before = at
    return dropped


def _least(left: Sequence[Kept], *, draws: bool) -> Kept:
    """Returns the snapshot that is missed least: of an earlier run, or the one with the best gap."""
    present = left[-1].run
    earlier = [each for each in left if each.run != present]
    run = [each for each in left if each.run == (earlier[0].run if earlier else present)]
    if len(run) <= 2:
        return run[0]
    worst = {
        run[at]: _gap(run[at - 1], run[at + 1]) / _allowed(run[at + 1], run[-1], draws=draws)
        for at in range(1, len(run) - 1)
    }
    return min(worst, key=lambda each: worst[each])


def _gap(before: Kept, after: Kept) -> float:
    return after.cost_s - before.cost_s


def _allowed(after: Kept, last: Kept, *, draws: bool) -> float:
    """Returns the work that a gap may hold which ends at a snapshot."""
    recent_s, old_s = _GAPS[draws]
    age_s = last.t - after.t
    return recent_s if age_s < RECENT_S else old_s if age_s < LONG_S else math.inf
