"""Errors of runs without a browser."""


class HeadlessError(Exception):
    """The run cannot be done; the text says why."""
