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
    title = "The executor did not answer"


class RunQuotaError(StudioError):
    """The user's stored runs would take more space than they may."""

    status = 413
    code = "quota_exceeded"
    title = "No room for this run"


class BadRangeError(StudioError):
    """A requested range of bytes is not in the recording."""

    status = 416
    code = "bad_range"
    title = "There are no such bytes"
