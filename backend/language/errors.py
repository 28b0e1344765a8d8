"""Errors of the support for Python."""

from __future__ import annotations

from backend.core.problems import StudioError


class UnavailableError(Exception):
    """No language server is available for this project; the text is for the user."""


class PythonRefusedError(StudioError):
    """The source is too long, or the tool did not answer."""

    status = 422
    code = "python_refused"
    title = "The Python cannot be read"


class NoTestsError(StudioError):
    """None of the user's tests of the project waits or runs."""

    status = 404
    code = "no_tests"
    title = "There are no tests to end"


class TestsEndedError(StudioError):
    """The user has ended the tests before they were done."""

    __test__ = False
    status = 409
    code = "tests_ended"
    title = "The tests were ended"


class CheckerUnavailableError(StudioError):
    """No formatter or linter is available at the moment."""

    status = 503
    code = "python_help_unavailable"
    title = "Python cannot be checked"
