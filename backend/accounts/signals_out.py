"""Signals that accounts send to other apps."""

from __future__ import annotations

from django.dispatch import Signal

account_leaves = Signal()
"""Sent before an account is deleted, with `user`."""
