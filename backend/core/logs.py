"""Formats log lines: as text for a terminal, or as one JSON object in each line for log collectors."""

from __future__ import annotations

import json
import logging
import sys
import time
from collections import Counter
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Final, Literal

if TYPE_CHECKING:
    from collections.abc import Callable

MOST_ALIKE: Final = 20
"""Number of warnings of one kind that are written in a period. No client may fill the disk with them."""
PERIOD_S: Final = 60.0
NOISY: Final = ("websockets", "uvicorn.error", "asyncio")
LAYER: Final = "channels_redis.pubsub"


class JsonFormatter(logging.Formatter):
    """Formats a record as `{time, level, logger, message, …}`; the `facts` of the record become fields."""

    def format(self, record: logging.LogRecord) -> str:
        """Returns one line, even if the text contains line breaks."""
        line = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        line |= getattr(record, "facts", {})
        if record.exc_info:
            line["exception"] = self.formatException(record.exc_info)
        return json.dumps(line, ensure_ascii=False, default=str)


class TextFormatter(logging.Formatter):
    """Formats lines for people, such as in a terminal."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(levelname)s %(name)s: %(message)s")

    def format(self, record: logging.LogRecord) -> str:
        """Returns the line, followed by the facts of the record."""
        facts = getattr(record, "facts", {})
        return super().format(record) + "".join(f" {name}={value}" for name, value in facts.items())


class Flood(logging.Filter):
    """Drops warnings of a kind that come too often.

    The first warning of the next period tells how many were dropped. The kind of a warning is its format
    string. Errors are never dropped.

    Args:
        clock: returns a monotonic time in seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._clock = clock
        self._began_s = clock()
        self._seen: Counter[tuple[str, str]] = Counter()
        self._dropped: dict[tuple[str, str], int] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Returns whether the record is written."""
        if record.levelno > logging.WARNING:
            return True
        now_s = self._clock()
        if now_s - self._began_s >= PERIOD_S:
            self._dropped = {kind: n - MOST_ALIKE for kind, n in self._seen.items() if n > MOST_ALIKE}
            self._began_s, self._seen = now_s, Counter()
        kind = (record.name, str(record.msg))
        self._seen[kind] += 1
        if self._seen[kind] > MOST_ALIKE:
            return False
        if (dropped := self._dropped.pop(kind, 0)) > 0:
            record.msg = f"{record.getMessage()} ({dropped} more of these came before)"
            record.args = None
        return True


class LostRedis(logging.Filter):
    """Reports once in a period, in one line, that the channel layer has lost Redis.

    The layer itself reports each of its tries, which is one a second, as an error with two tracebacks.

    Args:
        clock: returns a monotonic time in seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._clock = clock
        self._next_s = 0.0

    def filter(self, record: logging.LogRecord) -> bool:
        """Returns whether the record is written."""
        error = record.exc_info[1] if record.name == LAYER and record.exc_info else None
        if error is None or not type(error).__module__.startswith("redis."):
            return True
        now_s = self._clock()
        if now_s < self._next_s:
            return False
        self._next_s = now_s + PERIOD_S
        record.levelno, record.levelname = logging.WARNING, logging.getLevelName(logging.WARNING)
        record.msg, record.args = "Redis does not answer, and is asked again each second: %s", (error,)
        record.exc_info = record.exc_text = None
        return True


def set_up(level: str, style: Literal["text", "json"]) -> None:
    """Configures logging: the lines of this process go to its standard error."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonFormatter() if style == "json" else TextFormatter())
    handler.addFilter(LostRedis())
    handler.addFilter(Flood())
    logging.basicConfig(level=level.upper(), handlers=[handler])
    for name in NOISY:
        logging.getLogger(name).setLevel(logging.WARNING)
    # Django warns about each 4xx answer. These are normal here, and the access log has them.
    logging.getLogger("django.request").setLevel(logging.ERROR)
