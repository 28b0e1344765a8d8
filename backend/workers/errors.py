"""Errors of work that was handed to the pool.

StudioError
├─ BusyError         503, with Retry-After: too much waits already
├─ TookTooLongError  422: the deadline passed, the worker was ended
└─ WorkFailedError   422: the worker died, for want of memory as a rule
"""

from __future__ import annotations

from backend.core.problems import StudioError


class BusyError(StudioError):
    """Too much work waits for a worker."""

    status = 503
    code = "busy"
    title = "The server is busy"
    retry_after_s = 5


class TookTooLongError(StudioError):
    """The job exceeded its deadline."""

    status = 422
    code = "took_too_long"
    title = "The work took too long"


class WorkFailedError(StudioError):
    """The worker died while it did the job."""

    status = 422
    code = "work_failed"
    title = "The work could not be done"
