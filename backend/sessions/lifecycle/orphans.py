"""Ends what a killed server left: executors without a session, and sessions without an executor."""

from __future__ import annotations

import logging
from datetime import timedelta
from typing import TYPE_CHECKING, Final

from backend.config.environment import environment
from backend.sessions import queries
from backend.sessions.choices import SessionState
from backend.sessions.idleness import Ages
from backend.sessions.lifecycle import writes

if TYPE_CHECKING:
    from uuid import UUID

log = logging.getLogger(__name__)
_ages: Final = Ages()
"""How long each session has been starting."""


def end_orphans() -> None:
    """Ends executors and sessions that a killed server left; called before the first session starts.

    Of several servers, the one that maintains the sessions calls it every minute.

    If executors outlive the server, running sessions continue. Then this function ends only executors that
    the database does not know as running, and sessions whose start was never finished.
    """
    timeout_s = environment().session_stop_timeout_s
    survives = writes.launcher().survives_server
    overdue = _overdue() if survives else set()
    for session in queries.live_sessions():
        if session.state == SessionState.QUEUED and survives:
            continue
        if session.state == SessionState.STARTING and survives and session.id not in overdue:
            continue
        if session.state == SessionState.READY and survives and session.launcher_state:
            writes.refresh(session)  # an executor that has ended meanwhile says why
            continue
        if (
            not survives
            or not session.launcher_state
            or writes.launcher().poll(session.launcher_state) is not None
        ):
            state = session.launcher_state or writes.launcher().state_of(str(session.id))
            if state:
                writes.launcher().stop(state, timeout_s=timeout_s)
            writes.finish(session, SessionState.ENDED, "The server was restarted.")
    running = set(writes.launcher().running())  # first, since another server may be starting one
    known = {str(session.id) for session in queries.live_sessions()}
    for orphan in running - known:
        log.warning("the executor %s belongs to no session and is ended", orphan)
        writes.launcher().stop(writes.launcher().state_of(orphan), timeout_s=timeout_s)


def _overdue() -> set[UUID]:
    """Returns the sessions that have been starting for so long that no web server can still be at work."""
    starting = [one for one in queries.live_sessions() if one.state == SessionState.STARTING]
    # The time of its place counts, since it may have queued.
    ages = _ages.of({one.id: one.used_at or one.created_at for one in starting})
    return {one.id for one in starting if ages[one.id] > timedelta(seconds=2 * queries.start_timeout_s(one))}
