"""All that is kept of one user, as they may take it away."""

from __future__ import annotations

import io
import json
import zipfile
from typing import TYPE_CHECKING, Any

from backend.accounts.groups import groups_of
from backend.accounts.models import AuditEntry
from backend.projects import queries
from backend.projects.models import ChangeSet, Draft, Project
from backend.workers import zips

if TYPE_CHECKING:
    from backend.accounts.models import User


def archive_of(user: User) -> bytes:
    """A zip: `account.json`, and each project of theirs as the zip that export makes."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as folder:
        folder.writestr("account.json", json.dumps(_account(user), ensure_ascii=False, indent=2) + "\n")
        for project in Project.objects.filter(owner=user).order_by("name_key", "id"):
            place = "deleted" if project.deleted_at else "projects"
            files = zips.pack(queries.contents(project))
            folder.writestr(f"{place}/{project.name} ({project.id}).zip", files)
    return packed.getvalue()


def _account(user: User) -> dict[str, Any]:
    log = AuditEntry.objects.filter(actor=user).values("at", "action", "subject", "address")
    drafts = Draft.objects.filter(author=user).values("project__name", "path", "content", "updated_at")
    changes = ChangeSet.objects.filter(author=user).exclude(project__owner=user)
    document: dict[str, Any] = {
        "username": user.username,
        "name": user.get_full_name(),
        "email": user.email,
        "joined": user.date_joined,
        "last_sign_in": user.last_login,
        "groups": [group.name for group in groups_of(user)],
        "log": list(log),
        "drafts": list(drafts),
        "changes_in_projects_of_others": list(
            changes.values("project__name", "number", "message", "created_at")
        ),
    }
    plain: dict[str, Any] = json.loads(json.dumps(document, default=str))
    return plain
