"""Measures the disk space that users take."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from django.db.models import Count, Q, Sum

from backend.accounts.models import User
from backend.config.environment import environment
from backend.projects.errors import QuotaExceededError
from backend.projects.models import Project

if TYPE_CHECKING:
    from collections.abc import Iterable


def usage_of_all() -> Iterable[Any]:
    """Returns every account with the number (`kept`) and bytes (`used`) of its projects, largest first."""
    current = Q(projects__deleted_at=None)
    rows = User.objects.annotate(
        kept=Count("projects", filter=current), used=Sum("projects__size", filter=current)
    )
    return sorted(rows, key=lambda row: -(row.used or 0))


def room_for_archive(user: User) -> int:
    """Returns the largest size in bytes of an archive that this user may import.

    Raises:
        QuotaExceededError: the quota of projects or of bytes is used up.
    """
    used = usage(user)
    if used["projects"] >= used["max_projects"]:
        raise QuotaExceededError(
            f"You have {used['projects']} projects, and more are not allowed.",
            hint="Delete some that you no longer need.",
        )
    room = used["max_bytes"] - used["bytes"]
    if room <= 0:
        raise QuotaExceededError(
            f"Your projects take all of the {used['max_bytes']:,} bytes that you may have.",
            hint="Delete projects that you no longer need.",
        )
    return room


def usage(user: User) -> dict[str, int]:
    """Returns the number and bytes of a user's projects, and the quota."""
    limits = environment()
    rows = Project.objects.filter(owner=user, deleted_at=None)
    found = rows.aggregate(kept=Count("id"), used=Sum("size"))
    return {
        "projects": found["kept"],
        "max_projects": limits.max_user_projects if user.max_projects is None else user.max_projects,
        "bytes": found["used"] or 0,
        "max_bytes": limits.max_user_bytes if user.max_bytes is None else user.max_bytes,
    }
