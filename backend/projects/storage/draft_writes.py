"""Writes to drafts, which are unsaved texts of users."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db import transaction
from django.db.models.functions import Length
from django.utils import timezone

from backend.config.environment import environment
from backend.projects.errors import QuotaExceededError, matches
from backend.projects.models import Draft
from backend.projects.storage import names, queries
from backend.projects.storage.access import Need
from backend.projects.storage.writes import too_large

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User

CHANGED = "The draft has changed, in another tab perhaps."


@transaction.atomic
def save_draft(  # noqa: PLR0913 - a draft's columns
    project_id: UUID, path: str, *, acting_user: User, base_revision: int, content: str, if_match: str = ""
) -> Draft:
    """Stores the unsaved text of a user, and replaces the user's earlier draft of the file.

    Raises:
        PreconditionFailedError: `if_match` is not the ETag of the existing draft.
        QuotaExceededError: the text, or all drafts of the user in the project, are larger than a file may be.
    """
    project = queries.project(project_id, user=acting_user, need=Need.WRITE, lock=True)
    path = names.writable_path(path)
    rows = Draft.objects.filter(project=project, author=acting_user).defer("content")
    drafts = {row.path: row for row in rows.annotate(size=Length("content"))}
    before = drafts.pop(path, None)
    if len(content.encode()) > environment().max_file_bytes:
        raise too_large(path)
    if sum(row.size for row in drafts.values()) + len(content) > environment().max_file_bytes:
        raise QuotaExceededError(
            "Your unsaved texts in this project are larger than a file may be.",
            hint="Save some of them, or discard them.",
            field="content",
        )
    matches(if_match, queries.draft_etag(before), CHANGED)
    draft = before or Draft(project=project, author=acting_user, path=path)
    draft.base_revision, draft.content, draft.updated_at = base_revision, content, timezone.now()
    draft.save()
    return draft


@transaction.atomic
def discard_draft(project_id: UUID, path: str, *, acting_user: User, if_match: str = "") -> None:
    """Deletes a draft, if it exists."""
    project = queries.project(project_id, user=acting_user, need=Need.WRITE)
    rows = Draft.objects.filter(project=project, author=acting_user, path=names.file_path(path))
    matches(if_match, queries.draft_etag(rows.first()) if if_match else "", CHANGED)
    rows.delete()
