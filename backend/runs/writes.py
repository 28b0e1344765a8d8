"""All writes to stored runs."""

from __future__ import annotations

import hashlib
import os
from typing import IO, TYPE_CHECKING, Any, Final

from django.db import transaction
from django.utils import timezone

from backend.core.locks import transaction_lock
from backend.core.scratch import scratch
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need, RoleTooLowError
from backend.runs import queries
from backend.runs.errors import NoAnswerError, NotRecordedError, RunQuotaError
from backend.runs.length import DamagedError, length_of
from backend.runs.models import PART_BYTES, Run, RunPart
from backend.runs.pull import pull
from backend.sessions.choices import SessionState
from backend.sessions.queries import live_session
from backend.sessions.writes import manager_token

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project

__all__ = ["MOST_UNPINNED", "change", "delete", "keep", "stored"]

MOST_UNPINNED: Final = 20


def keep(project_id: UUID, asked: dict[str, Any], *, acting_user: User) -> Run:
    """Stores the recording of a run of the user's own session.

    Of the runs that a user keeps in a project, the last 20 stay, and all that are pinned.

    Raises:
        NotRecordedError: the user has no session of this project, or it has no such run.
        RunQuotaError: the user's runs take all the space that they may.
        NoAnswerError: the executor does not give the recording.
    """
    project = projects.project(project_id, user=acting_user, need=Need.RUN)
    session = live_session(project_id, user=acting_user)
    if session is None or session.state != SessionState.READY:
        raise NotRecordedError("No session of yours runs this project.", hint="Press Run, then keep the run.")
    with scratch().file(key=f"run of {acting_user.pk}") as file:
        most = queries.room(acting_user)
        pull(session.address, manager_token(session), asked["recorded_as"], file, most)
        try:
            return stored(file, project, acting_user, asked)
        except DamagedError as error:
            raise NoAnswerError(
                f"What the executor gave is no recording: {error}.", hint="Run again, and keep that run."
            ) from error


def stored(file: IO[bytes], project: Project, keeper: User, values: dict[str, Any]) -> Run:
    """Stores a recording as a run; without the name that a session gave it, its hash names it.

    Raises:
        DamagedError: the file is no recording.
        RunQuotaError: the keeper's runs take all the space that they may.
    """
    size = file.seek(0, os.SEEK_END)
    start_s, length_s = length_of(lambda at, length: _read(file, at, length), size)
    sha256 = _digest(file)
    found = {"size": size, "start_s": start_s, "length_s": length_s, "sha256": sha256}
    return _store(file, project, keeper, {"recorded_as": sha256[:32]} | values | found)


def change(project_id: UUID, run_id: UUID, asked: dict[str, Any], *, acting_user: User) -> Run:
    """Changes name, note and pin of a run, and whether it is shared. Only its keeper may share it.

    Raises:
        RoleTooLowError: the run is another user's, or the user may not share in this project.
    """
    shares = asked.get("is_shared", False)
    run = queries.run(project_id, run_id, user=acting_user, need=Need.WRITE if shares else Need.RUN)
    if shares and run.keeper_id != acting_user.pk:
        raise _of_another(run, "They can share it.")
    _require_own(run, acting_user)
    for name, value in asked.items():
        setattr(run, name, value)
    run.save(update_fields=list(asked))
    return run


def delete(project_id: UUID, run_id: UUID, *, acting_user: User) -> None:
    """Deletes a run.

    Raises:
        RoleTooLowError: the run is another user's.
    """
    run = queries.run(project_id, run_id, user=acting_user, need=Need.RUN)
    _require_own(run, acting_user)
    run.delete()


def _require_own(run: Run, user: User) -> None:
    if not queries.may_manage(run, user=user):
        raise _of_another(run, "They or the owner of the project can change it.")


def _of_another(run: Run, hint: str) -> RoleTooLowError:
    return RoleTooLowError(
        f"“{run.name}” was kept by {run.keeper.username}.", hint=hint, role=run.project.role.label
    )


@transaction.atomic
def _store(file: IO[bytes], project: Project, keeper: User, values: dict[str, Any]) -> Run:
    transaction_lock(f"runs of {keeper.pk}")  # of two that are kept at once, both count
    if values["size"] > queries.room(keeper):
        raise RunQuotaError(
            "Other runs that you kept meanwhile took the space.", hint="Delete runs that you no longer need."
        )
    run = Run.objects.create(project=project, keeper=keeper, created_at=timezone.now(), **values)
    file.seek(0)
    number = 0
    while data := file.read(PART_BYTES):
        RunPart.objects.create(run=run, number=number, data=data)
        number += 1
    older = Run.objects.filter(project=project, keeper=keeper, is_pinned=False).order_by("-created_at", "id")
    for row in older[MOST_UNPINNED:]:
        row.delete()
    return run


def _digest(file: IO[bytes]) -> str:
    digest = hashlib.sha256()
    file.seek(0)
    while data := file.read(PART_BYTES):
        digest.update(data)
    return digest.hexdigest()


def _read(file: IO[bytes], at: int, length: int) -> bytes:
    file.seek(at)
    return file.read(length)
