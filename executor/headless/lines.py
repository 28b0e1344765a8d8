"""What a run without a browser writes for people."""

from __future__ import annotations

from typing import Any

__all__ = ["mismatch_line"]


def mismatch_line(mismatch: dict[str, Any]) -> str:
    """Returns the line of a topic whose ends do not match."""
    return f"{mismatch['topic']}: {mismatch['message']} {mismatch['hint']}"
