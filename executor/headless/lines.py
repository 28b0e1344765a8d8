"""Lines that a run without a browser prints."""

from __future__ import annotations

__all__ = ["mismatch_line"]


def mismatch_line(topic: str, message: str, hint: str) -> str:
    """Returns the line of a topic whose ends do not match."""
    return f"{topic}: {message} {hint}"
