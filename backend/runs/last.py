"""The last run of each project and user, which is kept by itself when its session ends, however it ends.

An executor that is a child of this server leaves its recordings in a folder of its session. Each round of
maintenance takes the last run of every session that is over, and removes the folder; so does the first round
after a server was killed. The recordings of a container end with it, so the last run is fetched before it is
ended; that of a container that ended by itself is lost.
"""

from __future__ import annotations

import logging
import shutil
import threading
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final
from uuid import UUID

from django.db import Error, connection

from backend.config.environment import environment
from backend.core.objects.errors import StoreError
from backend.core.problems import StudioError
from backend.core.scratch import scratch
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.runs import queries, writes
from backend.runs.facts import join_newest
from backend.runs.length import DamagedError
from backend.runs.pull import LAST
from backend.sessions.choices import SessionKind
from backend.sessions.launchers.process import RUNS
from backend.sessions.lifecycle.writes import launcher, manager_token
from backend.sessions.models import LIVE_STATES, Session
from backend.workers.aside import sweeps

if TYPE_CHECKING:
    from pathlib import Path

    from backend.projects.models import Project

__all__ = ["fetch_last", "sweep", "sweep_soon"]

log = logging.getLogger(__name__)

FETCH_S: Final = 10.0
_sweeping: Final = threading.Lock()


def sweep_soon(sender: object, **_: object) -> None:
    """Starts a thread that sweeps, unless one runs already."""
    folder = launcher().recordings
    if folder is not None and folder.is_dir() and any(folder.iterdir()) and not _sweeping.locked():
        with suppress(StudioError):  # enough of it waits already
            sweeps.ask("server", sweep)


def sweep() -> int:
    """Keeps the last runs of the sessions that are over, and removes their folders; returns their number."""
    folder = launcher().recordings
    if folder is None or not folder.is_dir():
        return 0
    with _sweeping:
        over = [path for path in sorted(folder.iterdir()) if _is_over(path.name)]
        for path in over:
            _take(path)
        return len(over)


def fetch_last(sender: object, *, session: Session, **_: Any) -> None:
    """Keeps the last run of a session that is about to end, if its recordings end with it."""
    if launcher().recordings is not None or connection.in_atomic_block:
        return
    try:
        project = _project(session)
        if project is None:
            return
        source = writes.Source(project, session.address, manager_token(session), queries.room(session.user))
        fetched = writes.fetch(source, LAST, session.user_id, FETCH_S)
        with fetched.file as file:
            writes.store_last(file, fetched.facts, project, session.user)
    except StudioError as error:
        log.info("the last run of session %s is not kept: %s", session.id, error)


def _is_over(name: str) -> bool:
    try:
        session_id = UUID(name)
    except ValueError:
        return True  # nothing of ours
    return not Session.objects.filter(id=session_id, state__in=LIVE_STATES).exists()


def _take(folder: Path) -> None:
    try:
        _keep(folder)
    except (Error, StoreError) as error:  # the database or the object store is not there: in the next round
        log.warning("the last run in %s is kept later: %s", folder, error)
        return
    except (DamagedError, StudioError) as error:
        log.info("the last run in %s is not kept: %s", folder, error)
    except Exception:
        log.exception("the last run in %s is not kept", folder)
    shutil.rmtree(folder, ignore_errors=True)


def _keep(folder: Path) -> None:
    session = Session.objects.filter(id=folder.name).select_related("user").first()
    runs = folder / RUNS
    project = _project(session) if session is not None and runs.is_dir() else None
    if session is None or project is None:
        return
    with scratch().directory() as made:
        joined = made / "run.mcap"
        facts = join_newest(runs, joined, f"user {session.user_id}")
        if facts is not None:
            with joined.open("rb") as file:
                writes.store_last(file, facts, project, session.user)


def _project(session: Session) -> Project | None:
    """Returns the project of a session; None if its last run is not to be kept."""
    if not environment().keep_last_runs or session.project_id is None:
        return None
    if session.kind != SessionKind.INTERACTIVE:
        return None
    if not session.user.is_active:
        return None
    with suppress(StudioError):
        return projects.project(session.project_id, user=session.user, need=Need.RUN)
    return None
