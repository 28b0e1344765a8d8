"""`BufferCore`: stores the transforms between frames, and combines them."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING, Any, NamedTuple

from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.time import Time
from tf2_py.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from tf2_py.history import History, Sample, seconds
from tf2_py.motion import Motion, compose, inverse

if TYPE_CHECKING:
    from collections.abc import Iterator

CACHE_S = 10.0
_NOT_NORMALISED = 1e-2  # tolerated deviation of a quaternion's squared length from 1


class _Climb(NamedTuple):
    """A path up the tree.

    `frames` holds the pose of the first frame in each frame of the path; `ended` is the error that ended the
    path, or None.
    """

    frames: dict[str, Motion]
    ended: ExtrapolationException | None


class BufferCore:
    """Stores transforms for `cache_time`, which is 10 s by default.

    Static transforms are stored without limit.
    """

    def __init__(self, cache_time: Any = None) -> None:
        self._cache_ns = Duration(seconds=CACHE_S).nanoseconds if cache_time is None else _ns(cache_time)
        self._frames: dict[str, History] = {}
        self._lock = threading.RLock()

    def set_transform(self, transform: Any, authority: str = "default_authority") -> None:
        """Stores the transform of a frame at the time of its stamp; ignores an invalid one with a warning."""
        self._set(transform, authority, is_static=False)

    def set_transform_static(self, transform: Any, authority: str = "default_authority") -> None:
        """Stores a transform that is valid at all times."""
        self._set(transform, authority, is_static=True)

    def clear(self) -> None:
        """Removes all transforms except static ones."""
        with self._lock:
            for name, history in self._frames.items():
                if not history.is_static:
                    self._frames[name] = History(self._cache_ns)

    def all_frames_as_string(self) -> str:
        """Lists frames and their parents."""
        with self._lock:
            lines = [f"Frame {name} exists with parent {sample.parent}." for name, sample in self._hung()]
        return "".join(f"{line}\n" for line in lines)

    def all_frames_as_yaml(self) -> str:
        """Lists frames with their parents, stamps and rates, as YAML."""
        with self._lock:
            text = "".join(self._yaml(name, sample) for name, sample in self._hung())
        return text or "[]"

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Returns the latest time for which the transform between two frames is known.

        Raises:
            LookupException: a frame is not known.
            ConnectivityException: the frames are not connected.
        """
        with self._lock:
            self._check("get_latest_common_time", target_frame, source_frame)
            return Time(nanoseconds=self._latest_common(target_frame, source_frame))

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Returns the transform of data from `source_frame` into `target_frame`.

        `time` is a `rclpy.time.Time` or the message of one; 0 means the latest time for which both frames are
        known.

        Raises:
            LookupException: a frame is not known.
            ConnectivityException: the frames are not connected.
            ExtrapolationException: the time is outside of the stored samples.
            InvalidArgumentException: the name of a frame is invalid.
        """
        with self._lock:
            self._check("lookupTransform", target_frame, source_frame)
            stamp_ns, motion = self._look_up(target_frame, source_frame, _ns(time))
        return _message(target_frame, source_frame, stamp_ns, motion)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Any:
        """Returns the transform from one frame at one time into another frame at another time.

        Between the two times, the source is assumed to be at rest in `fixed_frame`. Raises the same
        exceptions as `lookup_transform_core`.
        """
        with self._lock:
            self._check("lookupTransform", target_frame, source_frame, fixed_frame)
            _, into_fixed = self._look_up(fixed_frame, source_frame, _ns(source_time))
            stamp_ns, from_fixed = self._look_up(target_frame, fixed_frame, _ns(target_time))
        return _message(target_frame, source_frame, stamp_ns, compose(from_fixed, into_fixed))

    def can_transform_core(self, target_frame: str, source_frame: str, time: Any) -> tuple[bool, str]:
        """Returns whether `lookup_transform_core` would succeed, and the reason if it would not."""
        try:
            self.lookup_transform_core(target_frame, source_frame, time)
        except TransformException as error:
            return False, str(error)
        return True, ""

    def can_transform_full_core(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> tuple[bool, str]:
        """Returns whether `lookup_transform_full_core` would succeed, and the reason if it would not."""
        try:
            self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)
        except TransformException as error:
            return False, str(error)
        return True, ""

    def _frameExists(self, frame_id: str) -> bool:  # noqa: N802 - its name in tf2
        return frame_id in self._known()

    def _getFrameStrings(self) -> list[str]:  # noqa: N802 - its name in tf2
        return sorted(self._known())

    def _set(self, transform: Any, authority: str, *, is_static: bool) -> None:
        child = transform.child_frame_id.lstrip("/")
        parent = transform.header.frame_id.lstrip("/")
        if problem := _problem_of(child, parent, transform.transform):
            get_logger("tf2_buffer").error(f"a transform from {authority!r} is ignored: {problem}")
            return
        sample = Sample(_ns(transform.header.stamp), parent, _motion(transform.transform), authority)
        with self._lock:
            history = self._frames.get(child)
            if history is None or history.is_static != is_static:
                history = self._frames[child] = History(self._cache_ns, is_static=is_static)
            history.add(sample)

    def _look_up(self, target: str, source: str, stamp_ns: int) -> tuple[int, Motion]:
        if stamp_ns == 0:
            stamp_ns = self._latest_common(target, source)
        up, down = self._climb(source, stamp_ns), self._climb(target, stamp_ns)
        for frame, from_target in down.frames.items():
            if frame in up.frames:
                return stamp_ns, compose(inverse(from_target), up.frames[frame])
        ended = up.ended or down.ended
        if ended is not None:
            raise ExtrapolationException(
                f"{ended}, when looking up transform from frame [{source}] to frame [{target}]"
            )
        raise self._unconnected(target, source)

    def _climb(self, frame: str, stamp_ns: int) -> _Climb:
        motion, frames = Motion(), {frame: Motion()}
        while history := self._frames.get(frame):
            try:
                sample = history.at(stamp_ns)
            except ExtrapolationException as error:
                return _Climb(frames, error)
            if sample.parent in frames:
                raise LookupException(f"The tf tree is invalid because it contains a loop at [{frame}].")
            frame, motion = sample.parent, compose(sample.motion, motion)
            frames[frame] = motion
        return _Climb(frames, None)

    def _latest_common(self, target: str, source: str) -> int:
        """Returns the latest time for which all frames on the path have a sample.

        0 if all frames are static.
        """
        up, down = self._latest_of(source), self._latest_of(target)
        common = next((frame for frame in down if frame in up), None)
        if common is None:
            raise self._unconnected(target, source)
        latest_ns = min(up[common], down[common])
        return 0 if math.isinf(latest_ns) else int(latest_ns)

    def _latest_of(self, frame: str) -> dict[str, float]:
        """Returns each ancestor of a frame with the latest time for which the path to it is known.

        Inf if the path is static.
        """
        known, found = math.inf, {frame: math.inf}
        while (history := self._frames.get(frame)) and (sample := history.latest):
            if not history.is_static:
                known = min(known, sample.stamp_ns)
            if sample.parent in found:
                raise LookupException(f"The tf tree is invalid because it contains a loop at [{frame}].")
            frame = sample.parent
            found[frame] = known
        return found

    def _check(self, function: str, *frames: str) -> None:
        known = self._known()
        for name, frame in zip(("target_frame", "source_frame", "fixed_frame"), frames, strict=False):
            if not frame or frame.startswith("/"):
                why = "frame_id cannot be empty" if not frame else "tf2 frame_ids cannot start with a '/'"
                raise InvalidArgumentException(
                    f"Invalid argument passed to {function} argument {name} - {why}"
                )
            if frame not in known:
                raise LookupException(f'"{frame}" passed to {function} argument {name} does not exist. ')

    def _known(self) -> set[str]:
        with self._lock:
            return {name for child, sample in self._hung() for name in (child, sample.parent)}

    def _hung(self) -> Iterator[tuple[str, Sample]]:
        for name, history in self._frames.items():
            if history.latest is not None:
                yield name, history.latest

    def _unconnected(self, target: str, source: str) -> ConnectivityException:
        return ConnectivityException(
            f"Could not find a connection between '{target}' and '{source}' because they are not part of "
            "the same tree. Tf has two or more unconnected trees."
        )

    def _yaml(self, name: str, latest: Sample) -> str:
        history = self._frames[name]
        oldest = history.oldest or latest
        length_s = (latest.stamp_ns - oldest.stamp_ns) * 1e-9
        rate = 10000.0 if length_s <= 0 else (len(history) - 1) / length_s
        return (
            f"{name}: \n  parent: '{latest.parent}'\n  broadcaster: '{latest.authority}'\n"
            f"  rate: {rate:.3f}\n  most_recent_transform: {seconds(latest.stamp_ns)}\n"
            f"  oldest_transform: {seconds(oldest.stamp_ns)}\n  buffer_length: {length_s:.3f}\n"
        )


def _problem_of(child: str, parent: str, transform: Any) -> str:
    """Returns the reason why a transform is invalid; "" if it is valid."""
    if not child or not parent:
        return "a frame has no name"
    if child == parent:
        return f"{child!r} is its own parent"
    move, turn = transform.translation, transform.rotation
    turned = (turn.x, turn.y, turn.z, turn.w)
    if not all(map(math.isfinite, (move.x, move.y, move.z, *turned))):
        return f"the transform of {child!r} is not finite"
    if abs(sum(part * part for part in turned) - 1.0) > _NOT_NORMALISED:
        return f"the quaternion of {child!r} is not of length 1"
    return ""


def _motion(transform: Any) -> Motion:
    move, turn = transform.translation, transform.rotation
    return Motion((move.x, move.y, move.z), (turn.x, turn.y, turn.z, turn.w))


def _message(target: str, source: str, stamp_ns: int, motion: Motion) -> Any:
    message = TransformStamped()
    message.header.stamp = Time(nanoseconds=stamp_ns).to_msg()
    message.header.frame_id, message.child_frame_id = target, source
    move, turn = message.transform.translation, message.transform.rotation
    move.x, move.y, move.z = motion.translation
    turn.x, turn.y, turn.z, turn.w = motion.rotation
    return message


def _ns(time: Any) -> int:
    """Returns a `Time`, a `Duration`, or the message of one of them, in nanoseconds."""
    if hasattr(time, "nanoseconds"):
        return int(time.nanoseconds)
    return int(time.sec) * 1_000_000_000 + int(time.nanosec)
