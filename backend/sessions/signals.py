"""Signals that sessions send to other apps."""

from __future__ import annotations

from django.dispatch import Signal

session_ends = Signal()
"""Sent with `session` before an executor that runs is ended. Receivers may ask it for a few seconds."""

sessions_maintained = Signal()
"""Sent after each round of maintenance, by the server that does it. Receivers return at once."""
