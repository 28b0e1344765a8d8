"""Errors of evaluations; the tree of exceptions starts at `backend.core.problems.StudioError`."""

from __future__ import annotations

from backend.core.problems import StudioError


class NoEvaluationError(StudioError):
    """The project has no evaluation of this name, or this server runs none."""

    status = 422
    code = "no_evaluation"
    title = "This cannot be evaluated"


class OnePlaceError(NoEvaluationError):
    """The one place of this server is kept for users who work."""

    code = "one_place"


class ArchivedError(NoEvaluationError):
    """The project is archived."""

    code = "project_archived"


class NotOlderError(NoEvaluationError):
    """The revision to compare with is not older than the one that was evaluated."""

    code = "revision_not_older"


class WrongStateError(StudioError):
    """The evaluation is in a state in which this is not possible."""

    status = 409
    code = "wrong_state"
    title = "Not now"


class NothingEvaluatedError(WrongStateError):
    """The evaluation has no outcome yet."""

    code = "nothing_evaluated"


class RunsAlreadyError(WrongStateError):
    """The evaluation waits or runs."""

    code = "evaluation_runs"


class TooManyWaitError(WrongStateError):
    """Too many evaluations of the project wait or run."""

    code = "too_many_evaluations"


class OutcomesFullError(WrongStateError):
    """The outcomes of the project's evaluations have reached their size."""

    code = "outcomes_full"


class ReportError(StudioError):
    """The results could not be put together."""

    status = 502
    code = "report_failed"
    title = "The results could not be put together"
