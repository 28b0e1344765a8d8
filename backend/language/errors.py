"""Why there is no help with Python."""

from __future__ import annotations

from backend.core.problems import StudioError


class UnavailableError(Exception):
    """There is no language server for this project here; the text is for the user."""


class PythonRefusedError(StudioError):
    """The source is not Python that could be formatted or read; `diagnostics` says where."""

    status = 422
    code = "python_refused"
    title = "The Python cannot be read"


class CheckerUnavailableError(StudioError):
    """Nothing can format or check Python here, or not now."""

    status = 503
    code = "python_help_unavailable"
    title = "Python cannot be checked"
