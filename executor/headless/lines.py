"""Lines that a run without a browser prints."""

from __future__ import annotations

__all__ = ["mismatch_line"]


def mismatch_line(topic: str, message: str, hint: str) -> str:
    """Returns the line about a topic whose publisher and subscriber do not match."""
    return f"{topic}: {message} {hint}"
