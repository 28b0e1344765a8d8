"""Errors of evaluations; the tree of exceptions starts at `backend.core.problems.StudioError`."""

from __future__ import annotations

from backend.core.problems import StudioError


class NoEvaluationError(StudioError):
    """The project has no evaluation of this name, or this server runs none."""

    status = 422
    code = "no_evaluation"
    title = "This cannot be evaluated"


class WrongStateError(StudioError):
    """The evaluation is in a state in which this is not possible."""

    status = 409
    code = "wrong_state"
    title = "Not now"


class ReportError(StudioError):
    """The results could not be put together."""

    status = 502
    code = "report_failed"
    title = "The results could not be put together"
