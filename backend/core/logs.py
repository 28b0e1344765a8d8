"""Formats log lines: as text for a terminal, or as one JSON object a line for log collectors."""

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
"""Lines of one kind in a period; what a client can cause without end must not fill a disk."""
PERIOD_S: Final = 60.0
NOISY: Final = ("websockets", "uvicorn.error", "asyncio")


class JsonFormatter(logging.Formatter):
    """`{time, level, logger, message, …}`; `facts` of a record become fields of the line."""

    def format(self, record: logging.LogRecord) -> str:
        """One line, whatever the text holds."""
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
    """For people."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(levelname)s %(name)s: %(message)s")

    def format(self, record: logging.LogRecord) -> str:
        """The line, with the facts of the record behind it."""
        facts = getattr(record, "facts", {})
        return super().format(record) + "".join(f" {name}={value}" for name, value in facts.items())


class Flood(logging.Filter):
    """Drops warnings of a kind that came too often, and says how many with the first of the next period.

    A kind is a text before its arguments are put in. Errors are never dropped.

    Args:
        clock: monotonic time in seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._clock = clock
        self._began_s = clock()
        self._seen: Counter[tuple[str, str]] = Counter()
        self._dropped: dict[tuple[str, str], int] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether the line is written."""
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


def set_up(level: str, style: Literal["text", "json"]) -> None:
    """Sends the log lines of this process to its standard error."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonFormatter() if style == "json" else TextFormatter())
    handler.addFilter(Flood())
    logging.basicConfig(level=level.upper(), handlers=[handler])
    for name in NOISY:
        logging.getLogger(name).setLevel(logging.WARNING)
    # Refusals are answers, not news.
    logging.getLogger("django.request").setLevel(logging.ERROR)
