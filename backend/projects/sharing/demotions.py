"""Sends notices when a user's role in a project ends or becomes lower, for any reason."""

from __future__ import annotations

from typing import Any

from django.db.models.signals import post_delete, post_save

from backend.accounts.rights import lessen
from backend.projects.models import GroupShare, Membership
from backend.projects.signals import project_deleted


def watch_roles() -> None:
    """Connects the receivers; called when the apps are ready."""
    for row in (Membership, GroupShare):
        post_delete.connect(_of_share, sender=row, dispatch_uid=f"lost {row.__name__}")
        post_save.connect(_of_share, sender=row, dispatch_uid=f"changed {row.__name__}")
    project_deleted.connect(_of_project, dispatch_uid="lost project")


def _of_share(instance: Membership | GroupShare, *, created: bool = False, **_: Any) -> None:
    if not created:
        lessen(project_id=instance.project_id)


def _of_project(project_id: Any, **_: Any) -> None:
    lessen(project_id=project_id)
