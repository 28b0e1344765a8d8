"""The poses of a world for a recording: noted often, packed for several moments at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import msgspec
import numpy as np

from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES, pack

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["POSES_HZ", "PoseTrack"]

POSES_HZ: Final = 30.0
MOVED_M: Final = 1e-4
SLACK_S: Final = 1e-6
_encode = msgspec.msgpack.Encoder().encode


class PoseTrack:
    """Notes which poses changed, in the form of the stream's frames.

    A pose is compared with the one that was noted last, so that slow ones are not lost.
    """

    def __init__(self) -> None:
        self._noted: NDArray[np.float32] | None = None
        self._next_s = 0.0
        self._times_s: list[float] = []
        self._rows: list[NDArray[np.intp]] = []
        self._poses: list[NDArray[np.float32]] = []

    def is_due(self, now_s: float) -> bool:
        """Whether the poses are to be noted at a simulated time."""
        return self._noted is None or now_s >= self._next_s

    def note(self, now_s: float, poses: NDArray[np.float32]) -> None:
        """Notes the rows [x, y, z, qx, qy, qz, qw] that changed; at first all of them."""
        self._next_s = max(self._next_s + 1.0 / POSES_HZ, now_s) - SLACK_S
        noted = self._noted
        if noted is None:
            self._noted = poses.copy()
            rows = np.arange(len(poses))
        else:
            rows = (np.abs(poses - noted) > MOVED_M).any(axis=1).nonzero()[0]
            if not len(rows):
                return
            noted[rows] = poses[rows]
        self._times_s.append(now_s)
        self._rows.append(rows)
        self._poses.append(poses[rows])

    def take(self) -> list[tuple[float, bytes]]:
        """Removes and returns what was noted: times in s, and frames `poses` of the stream."""
        if not self._times_s:
            return []
        packed = pack(np.concatenate(self._poses))
        found, start = [], 0
        for time_s, rows in zip(self._times_s, self._rows, strict=True):
            end = start + len(rows) * POSE_BYTES
            ids = rows.astype("<u2").tobytes()
            found.append((time_s, _encode(Poses(t=time_s, ids=ids, poses=packed[start:end]))))
            start = end
        self._times_s, self._rows, self._poses = [], [], []
        return found
