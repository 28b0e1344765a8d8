"""Errors of stored runs; the tree of exceptions starts at `backend.core.problems.StudioError`."""

from __future__ import annotations

from backend.core.problems import StudioError


class NotRecordedError(StudioError):
    """The session has no recording of this run."""

    status = 409
    code = "not_recorded"
    title = "Nothing is recorded"


class NoAnswerError(StudioError):
    """The executor did not give the whole recording."""

    status = 502
    code = "executor_failed"
    title = "The session did not answer"


class RunQuotaError(StudioError):
    """The user's stored runs would take more space than they may."""

    status = 413
    code = "quota_exceeded"
    title = "No room for this run"


class LogRefusedError(StudioError):
    """A file is no log of a robot that can be read."""

    status = 422
    code = "log_refused"
    title = "The log cannot be read"


class LogsUnavailableError(StudioError):
    """This server does not read logs of robots."""

    status = 503
    code = "logs_unavailable"
    title = "Logs cannot be read here"


class BadRangeError(StudioError):
    """A requested range of bytes is not in the recording."""

    status = 416
    code = "bad_range"
    title = "There are no such bytes"

    def __init__(self, size: int) -> None:
        super().__init__(f"The recording has {size} bytes.", hint="Ask for bytes before its end.")
        self._size = size

    @property
    def headers(self) -> dict[str, str]:
        """The size, as RFC 9110 wants it with this status."""
        return super().headers | {"Content-Range": f"bytes */{self._size}"}
