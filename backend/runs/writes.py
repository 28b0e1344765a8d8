"""All writes to stored runs."""

from __future__ import annotations

import hashlib
import os
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple

from django.db import transaction
from django.db.models import Sum
from django.utils import timezone

from backend.core.locks import transaction_lock
from backend.core.objects.store import written_store
from backend.core.scratch import scratch
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need, RoleTooLowError
from backend.runs import queries
from backend.runs.errors import NoAnswerError, NotRecordedError, RunQuotaError
from backend.runs.facts import facts_of
from backend.runs.length import DamagedError
from backend.runs.models import PART_BYTES, Run, RunPart
from backend.runs.objects import placed
from backend.runs.pull import DEADLINE_S, pull
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.lifecycle.writes import manager_token
from backend.sessions.queries import live_session
from backend.sessions.queries import session as any_session

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project
    from backend.runs.facts import Facts

__all__ = [
    "MOST_UNPINNED",
    "Fetched",
    "Source",
    "change",
    "delete",
    "fetch",
    "keep",
    "source",
    "store_last",
    "store_parts",
    "stored",
]

MOST_UNPINNED: Final = 20
SAME_S: Final = 1.0
"""A kept run that is at most so much shorter, in s, than the last one is the same run."""


class Source(NamedTuple):
    """A session from which the recording of a run is fetched."""

    project: Project
    address: str
    token: str
    most_bytes: int


class Fetched(NamedTuple):
    """A recording that was fetched from its session, with its facts. The caller closes the file."""

    file: IO[bytes]
    facts: Facts


def source(project_id: UUID, *, acting_user: User, attached: UUID | None = None) -> Source:
    """Returns the user's own session from which a run of a project can be kept.

    Args:
        project_id: the project that gets the run.
        acting_user: the user.
        attached: a session that follows another program; by default it is that of the project.

    Raises:
        NotRecordedError: the user has no such session.
    """
    project = projects.project(project_id, user=acting_user, need=Need.RUN)
    if attached is None:
        session = live_session(project_id, user=acting_user)
    elif (session := any_session(attached, user=acting_user)).kind != SessionKind.ATTACHED:
        raise NotRecordedError("This session follows no other program.", hint="Leave out the session.")
    if session is None or session.state != SessionState.READY:
        raise NotRecordedError("No session of yours runs this project.", hint="Press Run, then keep the run.")
    return Source(project, session.address, manager_token(session), queries.room(acting_user))


def fetch(asked: Source, recorded_as: str, user_id: int, deadline_s: float = DEADLINE_S) -> Fetched:
    """Fetches the recording of a run; reads nothing of the database. It takes seconds.

    Raises:
        NotRecordedError: the session has no such run.
        RunQuotaError: it is larger than there is room.
        NoAnswerError: the executor does not give the recording.
    """
    file = scratch().file(key=f"run of {user_id}")
    try:
        pull(asked.address, asked.token, recorded_as, file, asked.most_bytes, deadline_s)
        return Fetched(file, facts_of(file, f"user {user_id}"))
    except BaseException as error:
        file.close()
        if isinstance(error, DamagedError):
            raise NoAnswerError(
                f"What the session gave is no recording: {error}.", hint="Run again, and keep that run."
            ) from error
        raise


def keep(fetched: Fetched, project: Project, values: dict[str, Any], *, acting_user: User) -> Run:
    """Stores a fetched recording, and closes it.

    Of the runs that a user keeps in a project, the last 20 stay, and all that are pinned.

    Raises:
        RunQuotaError: the user's runs take all the space that they may.
    """
    with fetched.file as file:
        return stored(file, fetched.facts, project, acting_user, values)


def stored(file: IO[bytes], facts: Facts, project: Project, keeper: User, values: dict[str, Any]) -> Run:
    """Stores a recording as a run; without the name that a session gave it, its hash names it.

    Raises:
        RunQuotaError: the keeper's runs take all the space that they may.
    """
    found = _found(file, facts)
    if written_store(found["size"]) is not None:  # nothing is uploaded that is refused then
        _require_room(found["size"], keeper)
    with placed(file, found["size"], found["sha256"]) as key:
        return _store(file, project, keeper, found | {"stored_at": key} | values)


def store_last(file: IO[bytes], facts: Facts, project: Project, keeper: User) -> Run | None:
    """Stores a recording as the last run of a user in a project, in place of the one before.

    Returns None, and leaves the one before, where the user has kept this run, or there is no room.

    Raises:
        StoreError: the object store cannot be used now.
    """
    found: dict[str, Any] = {"name": "", "is_last": True} | _found(file, facts)
    if written_store(found["size"]) is not None and not _is_wanted(found, project, keeper):
        return None
    with placed(file, found["size"], found["sha256"]) as key, transaction.atomic():
        _lock(keeper)
        if not _is_wanted(found, project, keeper):
            return None
        Run.objects.filter(project=project, keeper=keeper, is_last=True).delete()
        return _store(file, project, keeper, found | {"stored_at": key})


def _is_wanted(found: dict[str, Any], project: Project, keeper: User) -> bool:
    """Returns whether the user has not kept this run, and has room for it in place of the one before."""
    same = Run.objects.filter(project=project, keeper=keeper, is_last=False, recorded_as=found["recorded_as"])
    if same.filter(length_s__gte=found["length_s"] - SAME_S).exists():
        return False
    before = Run.objects.filter(project=project, keeper=keeper, is_last=True)
    freed = before.aggregate(size=Sum("size"))["size"] or 0
    return bool(found["size"] <= queries.room(keeper) + freed)


def change(project_id: UUID, run_id: UUID, asked: dict[str, Any], *, acting_user: User) -> Run:
    """Changes name, note and pin of a run, and whether it is shared. Only its keeper may share it.

    A last run that is changed is a kept one from then on.

    Raises:
        RoleTooLowError: the run is another user's, or the user may not share in this project.
    """
    shares = asked.get("is_shared", False)
    run = queries.run(project_id, run_id, user=acting_user, need=Need.WRITE if shares else Need.RUN)
    if shares and run.keeper_id != acting_user.pk:
        raise _of_another(run, "They can share it.")
    _require_own(run, acting_user)
    asked = {"is_last": False} | asked
    if not run.name:
        asked = {"name": f"{run.created_at:%Y-%m-%d %H:%M}"} | asked
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
    _lock(keeper)
    _require_room(values["size"], keeper)
    run = Run.objects.create(project=project, keeper=keeper, created_at=timezone.now(), **values)
    if run.stored_at is None:
        store_parts(run, file)
    older = Run.objects.filter(project=project, keeper=keeper, is_pinned=False, is_last=False)
    for row in older.order_by("-created_at", "id").defer("thumbnail")[MOST_UNPINNED:]:
        row.delete()
    return run


def store_parts(run: Run, file: IO[bytes]) -> None:
    """Stores a recording in the database."""
    file.seek(0)
    number = 0
    while data := file.read(PART_BYTES):
        RunPart.objects.create(run=run, number=number, data=data)
        number += 1


def _require_room(size: int, keeper: User) -> None:
    if size > queries.room(keeper):
        raise RunQuotaError(
            "Other runs that you kept meanwhile took the space.", hint="Delete runs that you no longer need."
        )


def _lock(keeper: User) -> None:
    """Serialises the writes of one user, so that simultaneous ones cannot exceed the quota together."""
    transaction_lock(f"runs of {keeper.pk}")


def _found(file: IO[bytes], facts: Facts) -> dict[str, Any]:
    """Returns the columns that the server finds out by itself."""
    sha256 = _digest(file)
    return {
        "size": file.seek(0, os.SEEK_END),
        "sha256": sha256,
        "start_s": facts.start_s,
        "length_s": facts.length_s,
        "result": facts.result,
        "thumbnail": facts.thumbnail,
        "thumbnail_type": facts.thumbnail_type,
        "recorded_as": facts.run or sha256[:32],
    }


def _digest(file: IO[bytes]) -> str:
    digest = hashlib.sha256()
    file.seek(0)
    while data := file.read(PART_BYTES):
        digest.update(data)
    return digest.hexdigest()
