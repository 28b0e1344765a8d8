"""Keeps a log of a robot as a run."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import IO, TYPE_CHECKING, NamedTuple

from backend.core.scratch import scratch
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.runs.errors import LogRefusedError
from backend.runs.length import DamagedError
from backend.runs.models import MAX_NAME_LENGTH
from backend.runs.outside import convert, require_converter
from backend.runs.writes import stored

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project
    from backend.runs.models import Run

__all__ = ["Recording", "keep_log", "may_keep", "read_log"]


class Recording(NamedTuple):
    """A recording that was made of a log, and the name of the log."""

    name: str
    file: IO[bytes]


def may_keep(project_id: UUID, *, acting_user: User) -> Project:
    """Returns the project, if the user may keep runs with it, and this server reads logs.

    Raises:
        RoleTooLowError: the user may not.
        LogsUnavailableError: this server does not read logs.
    """
    project = projects.project(project_id, user=acting_user, need=Need.RUN)
    require_converter()
    return project


def read_log(log: IO[bytes], filename: str) -> Recording:
    """Returns what was made of a log; nothing of it stays on the disk once the file is closed.

    Raises:
        LogRefusedError: it is no log that can be read.
    """
    name = "".join(part for part in filename if part.isprintable())[-MAX_NAME_LENGTH:].strip() or "log"
    folder = scratch().folder
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(dir=folder) as made:
        return Recording(name, convert(log, name, Path(made)).open("rb"))


def keep_log(project: Project, recording: Recording, *, acting_user: User) -> Run:
    """Stores what was made of a log as a run of the user, and closes it.

    Raises:
        LogRefusedError: it is no recording.
        RunQuotaError: the user's runs take all the space that they may.
    """
    name, file = recording
    with file:
        try:
            return stored(file, project, acting_user, {"name": name})
        except DamagedError as error:
            text = f"{name}: no recording was made of it: {error}."
            raise LogRefusedError(text, hint="Does the log have any changes?", reason="damaged") from error
