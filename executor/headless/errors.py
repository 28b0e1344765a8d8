"""Errors of runs without a browser."""


class HeadlessError(Exception):
    """The run cannot be started or continued; the text is the reason."""
