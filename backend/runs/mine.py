"""The stored runs of a user in all projects: their list, size, and files for the zip of all data."""

from __future__ import annotations

import json
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from django.core.serializers.json import DjangoJSONEncoder
from django.db.models import Count, Sum

from backend.config.environment import environment
from backend.core.problems import NotFoundError
from backend.projects.choices import Role
from backend.projects.signals import MoreData
from backend.projects.storage.access import find_roles
from backend.runs import queries
from backend.runs.models import Run

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User

__all__ = ["data_of", "delete_mine", "mine", "usage_of"]

MOST_LISTED: Final = 100
_TOLD: Final = ("project__name", "name", "note", "result", "length_s", "size", "is_shared", "created_at")


def mine(user: User) -> list[Run]:
    """Returns the runs that a user has kept, the newest first; each has the user's role in its project.

    Runs of projects that the user may no longer read are in it, since they count to the quota.
    """
    rows = Run.objects.filter(keeper=user).select_related("project", "keeper").defer("thumbnail")
    found = list(rows.order_by("-created_at", "id")[:MOST_LISTED])
    find_roles([run.project for run in found], user)
    for run in found:
        is_there = run.project.deleted_at is None
        run.project.role = Role(getattr(run.project, "rank", Role.NONE)) if is_there else Role.NONE
    return found


def delete_mine(run_id: UUID, *, acting_user: User) -> None:
    """Deletes a run that a user has kept, also one of a project that they may no longer read.

    Raises:
        NotFoundError: there is no such run of theirs.
    """
    found = Run.objects.filter(id=run_id, keeper=acting_user).defer("thumbnail").first()
    if found is None:
        raise NotFoundError("There is no such run.")
    found.delete()


def usage_of(sender: object, *, user: User, **_: object) -> dict[str, int]:
    """Returns the number and bytes of a user's runs, and the quota."""
    found = Run.objects.filter(keeper=user).aggregate(kept=Count("id"), used=Sum("size"))
    limit = environment().max_user_run_bytes
    return {"runs": found["kept"], "run_bytes": found["used"] or 0, "max_run_bytes": limit}


def data_of(sender: object, *, user: User, **_: object) -> MoreData:
    """Returns the user's runs for the zip of all their data."""
    runs = list(Run.objects.filter(keeper=user).defer("thumbnail").order_by("created_at", "id"))
    told = list(Run.objects.filter(keeper=user).order_by("created_at", "id").values(*_TOLD))
    document: dict[str, Any] = {"runs": json.loads(json.dumps(told, cls=DjangoJSONEncoder))}
    return MoreData(document, [(_path(run), partial(queries.parts, run, 0, run.size)) for run in runs])


def _path(run: Run) -> str:
    name = "".join("-" if letter in "/\\:" or not letter.isprintable() else letter for letter in run.name)
    return f"runs/{name or 'last run'} ({run.id}).mcap"
