"""Combines messages of several topics that have the same time, exactly or approximately."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from message_filters.simple import SimpleFilter, stamp_of
from rclpy.duration import Duration

if TYPE_CHECKING:
    from collections.abc import Sequence


class TimeSynchronizer(SimpleFilter):
    """Passes on one message of each input when all have the same stamp.

    At most `queue_size` messages of each input wait for the others.
    """

    def __init__(self, fs: Sequence[Any], queue_size: int) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.lock = threading.RLock()
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[Any]) -> None:  # noqa: N802 - its name in ROS
        """Connects the outputs of filters as inputs."""
        self.queues: list[dict[int, Any]] = [{} for _ in fs]
        self.input_connections = [
            source.registerCallback(self.add, queue, index)
            for index, (source, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Adds a message of one input; passes on a complete set."""
        stamp = stamp_of(msg, allow_headerless=False, who="message_filters")
        if stamp is None:
            return
        with self.lock:
            self._keep(msg, my_queue, stamp.nanoseconds)
            if all(stamp.nanoseconds in queue for queue in self.queues):
                self._put_out([stamp.nanoseconds] * len(self.queues))

    def _keep(self, msg: Any, queue: dict[int, Any], stamp_ns: int) -> None:
        queue[stamp_ns] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]

    def _put_out(self, stamps: Sequence[int]) -> None:
        found = [queue.pop(stamp) for queue, stamp in zip(self.queues, stamps, strict=True)]
        self.signalMessage(*found)


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on one message of each input when their stamps differ by less than `slop` seconds.

    For each of the other inputs, the message whose stamp is nearest to that of the new one is tried first.
    With `allow_headerless`, a message without a stamp gets the time of its arrival.
    """

    def __init__(
        self,
        fs: Sequence[Any],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,  # noqa: FBT001, FBT002 - as in ROS
    ) -> None:
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless
        super().__init__(fs, queue_size)

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """Adds a message of one input; passes on a complete set."""
        stamp = stamp_of(msg, allow_headerless=self.allow_headerless, who="message_filters_approx")
        if stamp is None:
            return
        with self.lock:
            now = stamp.nanoseconds
            self._keep(msg, my_queue, now)
            if now not in my_queue:  # older than all waiting messages
                return
            near = [[now] if queue is my_queue else self._near(queue, now) for queue in self.queues]
            if (stamps := self._fitting(near, [])) is not None:
                self._put_out(stamps)

    def _near(self, queue: dict[int, Any], now: int) -> list[int]:
        """Returns the stamps of a queue that are within the slop of `now`, nearest first.

        Of two equally near stamps the older one is first.
        """
        near = [stamp for stamp in queue if abs(stamp - now) <= self.slop.nanoseconds]
        return sorted(near, key=lambda stamp: (abs(stamp - now), stamp))

    def _fitting(self, near: Sequence[Sequence[int]], taken: list[int]) -> list[int] | None:
        """Returns one stamp from each list in `near`: the first choice whose spread is less than the slop.

        Returns None if there is none.
        """
        if taken and max(taken) - min(taken) >= max(self.slop.nanoseconds, 1):
            return None
        if len(taken) == len(near):
            return taken
        choices = (self._fitting(near, [*taken, stamp]) for stamp in near[len(taken)])
        return next((choice for choice in choices if choice is not None), None)
