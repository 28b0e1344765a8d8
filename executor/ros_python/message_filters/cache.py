"""`Cache`: the last messages of a topic, by time."""

from __future__ import annotations

from typing import Any

from message_filters.simple import SimpleFilter, stamp_of


class Cache(SimpleFilter):
    """Stores the last `cache_size` messages, and passes each on when it arrives."""

    def __init__(self, f: Any, cache_size: int = 1, allow_headerless: bool = False) -> None:  # noqa: FBT001, FBT002
        super().__init__()
        self.cache_size, self.allow_headerless = cache_size, allow_headerless
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Any] = []
        self.connectInput(f)

    def connectInput(self, f: Any) -> None:  # noqa: N802 - its name in ROS
        """Connects the output of a filter as the input of this cache."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Stores a message."""
        stamp = stamp_of(msg, allow_headerless=self.allow_headerless, who="message_filters_cache")
        if stamp is None:
            return
        self.cache_times = [*self.cache_times, stamp][-self.cache_size :]
        self.cache_msgs = [*self.cache_msgs, msg][-self.cache_size :]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:  # noqa: N802 - its name in ROS
        """Returns the messages from one time up to another, both included."""
        if from_stamp > to_stamp:
            raise ValueError("the interval ends before it begins")
        return [msg for stamp, msg in self._kept() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp: Any) -> Any:  # noqa: N802 - its name in ROS
        """Returns the oldest message at this time or later; None if there is none."""
        return next((msg for time, msg in self._kept() if time >= stamp), None)

    def getElemBeforeTime(self, stamp: Any) -> Any:  # noqa: N802 - its name in ROS
        """Returns the newest message at this time or earlier; None if there is none."""
        return next((msg for time, msg in reversed(self._kept()) if time <= stamp), None)

    def getLatestTime(self) -> Any:  # noqa: N802 - its name in ROS
        """Returns the time of the newest message; None if there is none."""
        return self.cache_times[-1] if self.cache_times else None

    getLastestTime = getLatestTime  # noqa: N815 - so it is written in ROS 2 Jazzy

    def getOldestTime(self) -> Any:  # noqa: N802 - its name in ROS
        """Returns the time of the oldest message; None if there is none."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:  # noqa: N802 - its name in ROS
        """Returns the newest message; None if there is none."""
        return self.cache_msgs[-1] if self.cache_msgs else None

    def _kept(self) -> list[tuple[Any, Any]]:
        return list(zip(self.cache_times, self.cache_msgs, strict=True))
