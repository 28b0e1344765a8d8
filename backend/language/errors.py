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


class CheckerUnavailableError(StudioError):
    """No formatter or linter is available at the moment."""

    status = 503
    code = "python_help_unavailable"
    title = "Python cannot be checked"
