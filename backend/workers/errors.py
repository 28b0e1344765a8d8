"""Errors of jobs in the pool.

StudioError
├─ BusyError         503, with Retry-After: too many jobs wait
├─ TookTooLongError  422: the job exceeded its deadline, the worker was killed
└─ WorkFailedError   422: the worker crashed, usually for lack of memory
"""

from __future__ import annotations

from backend.core.problems import StudioError


class BusyError(StudioError):
    """Too many jobs wait for a worker."""

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
