"""The progress line of a command."""

from __future__ import annotations

import sys


def show_progress(text: str) -> None:
    """Rewrites the progress line, if the output is a terminal; an empty text removes it."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()
