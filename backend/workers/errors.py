"""Errors of jobs in the pool.

StudioError
├─ BusyError         503, with Retry-After: too many jobs wait, or workers were ended from outside
├─ TookTooLongError  422: the job exceeded its deadline, the worker was killed
└─ WorkFailedError   422: the job crashed its worker, usually for lack of memory
"""

from __future__ import annotations

from backend.core.problems import ServerBusyError, StudioError


class BusyError(ServerBusyError):
    """Too many jobs wait for a worker, or something else than the job has ended its workers."""


class TookTooLongError(StudioError):
    """The job exceeded its deadline."""

    status = 422
    code = "took_too_long"
    title = "The work took too long"


class WorkFailedError(StudioError):
    """The job ended its worker, or failed by a fault of BT Studio."""

    status = 422
    code = "work_failed"
    title = "The work could not be done"
