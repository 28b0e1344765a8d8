"""The poses of one frame in its parent, over time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import NamedTuple

from tf2_py.errors import ExtrapolationException
from tf2_py.motion import Motion, between


class Sample(NamedTuple):
    """The pose of a frame at a time in ns."""

    stamp_ns: int
    parent: str
    motion: Motion
    authority: str = ""


class History:
    """The samples of one frame, in the order of their stamps.

    A static frame has one sample, which is always valid.
    """

    def __init__(self, cache_ns: int, *, is_static: bool = False) -> None:
        self.is_static = is_static
        self._cache_ns = cache_ns
        self._samples: list[Sample] = []

    def add(self, sample: Sample) -> bool:
        """Adds a sample and removes old ones; returns False if the sample is not new, or too old."""
        if self.is_static:
            self._samples = [sample]
            return True
        stamps = [each.stamp_ns for each in self._samples[-1:]]
        if stamps and sample.stamp_ns < stamps[0] - self._cache_ns:
            return False
        place = bisect_left(self._samples, sample.stamp_ns, key=_stamp)
        if place < len(self._samples) and self._samples[place].stamp_ns == sample.stamp_ns:
            return False
        self._samples.insert(place, sample)
        oldest_ns = self._samples[-1].stamp_ns - self._cache_ns
        del self._samples[: bisect_left(self._samples, oldest_ns, key=_stamp)]
        return True

    @property
    def latest(self) -> Sample | None:
        """The sample with the latest stamp; None if there is no sample."""
        return self._samples[-1] if self._samples else None

    @property
    def oldest(self) -> Sample | None:
        """The sample with the earliest stamp; None if there is no sample."""
        return self._samples[0] if self._samples else None

    def __len__(self) -> int:
        return len(self._samples)

    def at(self, stamp_ns: int) -> Sample:
        """Returns the interpolated sample at a time; 0 means the latest stamp.

        Raises:
            ExtrapolationException: the time is outside of the stored samples.
        """
        if self.is_static or stamp_ns == 0:
            return self._samples[-1]
        place = bisect_right(self._samples, stamp_ns, key=_stamp)
        before = self._samples[place - 1] if place else None
        if before is not None and before.stamp_ns == stamp_ns:
            return before
        if before is None or place == len(self._samples):
            raise ExtrapolationException(self._outside(stamp_ns))
        after = self._samples[place]
        if after.parent != before.parent:  # between two parents the old one is valid
            return before._replace(stamp_ns=stamp_ns)
        share = (stamp_ns - before.stamp_ns) / (after.stamp_ns - before.stamp_ns)
        return Sample(stamp_ns, before.parent, between(before.motion, after.motion, share), before.authority)

    def _outside(self, stamp_ns: int) -> str:
        first, last = self._samples[0].stamp_ns, self._samples[-1].stamp_ns
        if first == last:
            return (
                f"Lookup would require extrapolation at time {seconds(stamp_ns)}, "
                f"but only time {seconds(first)} is in the buffer"
            )
        into, end, name = ("past", first, "earliest") if stamp_ns < first else ("future", last, "latest")
        return (
            f"Lookup would require extrapolation into the {into}.  "
            f"Requested time {seconds(stamp_ns)} but the {name} data is at time {seconds(end)}"
        )


def seconds(stamp_ns: int) -> str:
    """Formats a stamp in seconds."""
    return f"{stamp_ns // 1_000_000_000}.{stamp_ns % 1_000_000_000:09d}"


def _stamp(sample: Sample) -> int:
    return sample.stamp_ns
