"""Keeps a log of a robot as a run."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import IO, TYPE_CHECKING, NamedTuple

from backend.core.scratch import scratch
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
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

__all__ = ["Recording", "keep_log", "may_keep", "read_log"]


class Recording(NamedTuple):
    """A recording that was made of a log, the name of the log, and what it says."""

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


def read_log(log: IO[bytes], filename: str, owner: str) -> Recording:
    """Returns what was made of a log; nothing of it stays on the disk once the file is closed.

    Raises:
        LogRefusedError: it is no log that can be read.
    """
    name = "".join(part for part in filename if part.isprintable())[-MAX_NAME_LENGTH:].strip() or "log"
    folder = scratch().folder
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(dir=folder) as made:
        file = convert(log, name, Path(made)).open("rb")
    try:
        return Recording(name, file, facts_of(file, owner))
    except DamagedError as error:
        file.close()
        text = f"{name}: no recording was made of it: {error}."
        raise LogRefusedError(text, hint="Does the log have any changes?", reason="damaged") from error


def keep_log(project: Project, recording: Recording, *, acting_user: User) -> Run:
    """Stores what was made of a log as a run of the user, and closes it.

    Raises:
        RunQuotaError: the user's runs take all the space that they may.
    """
    with recording.file as file:
        return stored(file, recording.facts, project, acting_user, {"name": recording.name})
