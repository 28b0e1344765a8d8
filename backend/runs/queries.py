"""Reads of stored runs, and who may see them.

The one who kept a run and the owner of its project see it; all others who may read the project see it once it
is shared. Guests with a link see shared runs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db.models import Q, Sum

from backend.config.environment import environment
from backend.core.objects.errors import ObjectMissingError
from backend.core.objects.store import the_store
from backend.core.problems import NotFoundError
from backend.projects.choices import Role
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.runs.models import PART_BYTES, Run, RunPart

if TYPE_CHECKING:
    from collections.abc import Iterator
    from uuid import UUID

    from django.db.models import QuerySet

    from backend.accounts.models import User
    from backend.projects.models import Project

__all__ = ["may_manage", "may_share", "parts", "room", "run", "runs"]


def runs(project_id: UUID, *, user: User) -> list[Run]:
    """Returns the runs of a project that a user may see: pinned ones first, then the newest."""
    project = projects.project(project_id, user=user, need=Need.READ)
    rows = _visible(project, user).select_related("keeper").defer("thumbnail")
    found = list(rows.order_by("-is_pinned", "-created_at", "id"))
    for row in found:
        row.project = project  # it has the user's role
    return found


def run(
    project_id: UUID, run_id: UUID, *, user: User, need: Need = Need.READ, has_thumbnail: bool = False
) -> Run:
    """Returns a run that a user may see; with `has_thumbnail` its picture is read with it.

    Raises:
        NotFoundError: the project or the run does not exist, or the user may not know of it.
        RoleTooLowError: the user's role in the project does not suffice.
    """
    project = projects.project(project_id, user=user, need=need)
    rows = _visible(project, user).select_related("keeper")
    found = (rows if has_thumbnail else rows.defer("thumbnail")).filter(id=run_id).first()
    if found is None:
        raise NotFoundError("There is no such run.")
    found.project = project
    return found


def may_manage(found: Run, *, user: User) -> bool:
    """Returns whether a user may rename, pin and delete a run."""
    return found.keeper_id == user.pk or found.project.role == Role.OWNER


def may_share(found: Run, *, user: User) -> bool:
    """Returns whether a user may share a run: who kept it, and may write in the project."""
    return found.keeper_id == user.pk and found.project.role >= Role.EDITOR


def room(user: User) -> int:
    """Returns the number of bytes that the user's runs may still take."""
    used = Run.objects.filter(keeper=user).aggregate(used=Sum("size"))["used"] or 0
    return environment().max_user_run_bytes - int(used)


def parts(found: Run, begin: int, end: int) -> Iterator[bytes]:
    """Yields the bytes of a recording from `begin` to before `end`, wherever they are.

    A recording that is moved meanwhile is read on at its new place.

    Raises:
        StoreError: the recording is in the object store, and it cannot be read.
    """
    key, moves = found.stored_at, 0
    while begin < end:
        try:
            for data in the_store().read(key, begin, end) if key else _rows(found, begin, end):
                yield data
                begin += len(data)
            return
        except (ObjectMissingError, RunPart.DoesNotExist):
            row = Run.objects.filter(pk=found.pk).values_list("stored_at", flat=True).first()
            moves += 1
            if row == key or moves > 2:
                raise
            key = row


def _rows(found: Run, begin: int, end: int) -> Iterator[bytes]:
    for number in range(begin // PART_BYTES, -(-end // PART_BYTES)):
        data = bytes(RunPart.objects.values_list("data", flat=True).get(run=found, number=number))
        at = number * PART_BYTES
        yield data[max(0, begin - at) : max(0, end - at)]


def _visible(project: Project, user: User) -> QuerySet[Run]:
    rows = Run.objects.filter(project=project)
    if user.is_guest:
        return rows.filter(is_shared=True)
    if project.role == Role.OWNER:
        return rows
    return rows.filter(Q(keeper=user) | Q(is_shared=True))
