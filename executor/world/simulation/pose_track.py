"""The poses of a world for a recording: noted often, packed for several moments at once."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import msgspec
import numpy as np

from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES, pack

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

__all__ = ["POSES_HZ", "PoseTrack"]

POSES_HZ: Final = 30.0
MOVED_M: Final = 1e-4
SLACK_S: Final = 1e-6
_encode = msgspec.msgpack.Encoder().encode


class PoseTrack:
    """Notes poses, and finds those that changed, in the form of the stream's frames.

    A pose is compared with the one that was written last, so that slow ones are not lost. They are to be
    noted next at the simulated time `next_s`.
    """

    def __init__(self) -> None:
        self._written: NDArray[np.float32] | None = None
        self.next_s = -math.inf
        self._noted: list[tuple[float, Callable[[], NDArray[np.float32]]]] = []

    def note(self, now_s: float, poses: Callable[[], NDArray[np.float32]]) -> None:
        """Notes what computes the rows [x, y, z, qx, qy, qz, qw] of all objects at this moment."""
        self.next_s = max(self.next_s + 1.0 / POSES_HZ, now_s) - SLACK_S
        self._noted.append((now_s, poses))

    def take(self) -> list[tuple[float, bytes]]:
        """Removes what was noted; returns the times in s, and frames `poses` of the stream.

        A frame holds the poses that changed; the first one holds all.
        """
        times_s: list[float] = []
        rows: list[NDArray[np.intp]] = []
        changed: list[NDArray[np.float32]] = []
        for now_s, compute in self._noted:
            poses = compute()
            moved = self._moved(poses)
            if len(moved):
                times_s.append(now_s)
                rows.append(moved)
                changed.append(poses[moved])
        self._noted = []
        if not times_s:
            return []
        packed = pack(np.concatenate(changed))
        found, start = [], 0
        for time_s, moved in zip(times_s, rows, strict=True):
            end = start + len(moved) * POSE_BYTES
            ids = moved.astype("<u2").tobytes()
            found.append((time_s, _encode(Poses(t=time_s, ids=ids, poses=packed[start:end]))))
            start = end
        return found

    def _moved(self, poses: NDArray[np.float32]) -> NDArray[np.intp]:
        """Returns the rows that differ from those that were written last, and notes them."""
        if self._written is None:
            self._written = poses.copy()
            return np.arange(len(poses))
        moved: NDArray[np.intp] = (np.abs(poses - self._written) > MOVED_M).any(axis=1).nonzero()[0]
        self._written[moved] = poses[moved]
        return moved
