"""Keeps a log of a robot as a run."""

from __future__ import annotations

import json
import re
from typing import IO, TYPE_CHECKING, NamedTuple

from django.db import transaction

from backend.core.scratch import scratch
from backend.projects.choices import Role
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.projects.storage.manifest import MANIFEST
from backend.projects.storage.writes import create_project
from backend.runs.errors import LogRefusedError
from backend.runs.facts import facts_of
from backend.runs.length import DamagedError
from backend.runs.models import MAX_NAME_LENGTH
from backend.runs.outside import convert, require_converter
from backend.runs.writes import stored

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project
    from backend.runs.facts import Facts
    from backend.runs.models import Run

__all__ = ["Recording", "keep_log", "may_keep", "open_log", "read_log", "title"]


class Recording(NamedTuple):
    """A recording that was converted from a log, with the name of the log and the facts of the run."""

    name: str
    file: IO[bytes]
    facts: Facts


def may_keep(project_id: UUID, *, acting_user: User) -> Project:
    """Returns the project, if the user may keep runs with it, and this server reads logs.

    Raises:
        RoleTooLowError: the user may not.
        LogsUnavailableError: this server does not read logs.
    """
    project = projects.project(project_id, user=acting_user, need=Need.RUN)
    require_converter()
    return project


def open_log(recording: Recording, files: dict[str, bytes], *, acting_user: User) -> Run:
    """Stores a converted log as a run of a new project, and closes it.

    Args:
        recording: the converted log.
        files: the project; without files it is an empty one, named as the log.
        acting_user: who owns both.

    Raises:
        QuotaExceededError, RunQuotaError: there is no room for the project, or for the run.
    """
    with recording.file, transaction.atomic():
        manifest = json.loads(files.get(MANIFEST, b"{}")) | {"name": title(recording.name)}
        named = {**files, MANIFEST: json.dumps(manifest, ensure_ascii=False, indent=2).encode()}
        project = create_project(named, acting_user=acting_user, message=f"Open {recording.name}")
        project.role = Role.OWNER
        return keep_log(project, recording, acting_user=acting_user)


def title(name: str) -> str:
    """Returns the name of a project for a log."""
    clean = re.sub(r"[/\\]", "-", name).removesuffix(".btlog").removesuffix(".mcap").removesuffix(".db3")
    return clean.strip(" .")[:MAX_NAME_LENGTH] or "Log"


def read_log(log: IO[bytes], filename: str, owner: str) -> Recording:
    """Converts a log; nothing of it stays on the disk once the file is closed.

    Raises:
        LogRefusedError: it is no log that can be read.
    """
    name = "".join(part for part in filename if part.isprintable())[-MAX_NAME_LENGTH:].strip() or "log"
    with scratch().directory() as made:
        file = convert(log, name, made).open("rb")
    try:
        return Recording(name, file, facts_of(file, owner))
    except DamagedError as error:
        file.close()
        text = f"{name}: no recording was made of it: {error}."
        raise LogRefusedError(text, hint="Does the log have any changes?", reason="damaged") from error


def keep_log(project: Project, recording: Recording, *, acting_user: User) -> Run:
    """Stores a converted log as a run of the user, and closes it.

    Raises:
        RunQuotaError: the user's runs take all the space that they may.
    """
    with recording.file as file:
        return stored(file, recording.facts, project, acting_user, {"name": recording.name})
