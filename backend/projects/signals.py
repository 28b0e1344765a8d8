"""Signals that projects send to other apps."""

from __future__ import annotations

from django.dispatch import Signal

project_deleted = Signal()
"""Sent with `project_id` when the deletion of a project is committed."""

revision_made = Signal()
"""Sent with `change`, a `ChangeSet`, in its transaction."""
