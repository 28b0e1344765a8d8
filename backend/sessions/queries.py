"""Reads of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from django.db.models import Count

from backend.config.environment import environment
from backend.core.problems import NotFoundError
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.models import LIVE_STATES, Session

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User


OF_USERS: Final = (SessionKind.INTERACTIVE, SessionKind.ATTACHED)
"""The kinds of sessions that a page works in."""


def session(session_id: UUID, *, user: User) -> Session:
    """Returns the session, if this user works in it."""
    found = Session.objects.filter(id=session_id, user=user, kind__in=OF_USERS).first()
    if found is None:
        raise NotFoundError("There is no such session.")
    return found


def live_session(
    project_id: UUID, *, user: User, kind: SessionKind = SessionKind.INTERACTIVE
) -> Session | None:
    """Returns the session that runs this project for this user, or None."""
    rows = Session.objects.filter(project_id=project_id, user=user, kind=kind, state__in=LIVE_STATES)
    return rows.first()


def attached_session(target: str, *, user: User) -> Session | None:
    """Returns the session in which this user follows a program, or None."""
    rows = Session.objects.filter(target=target, user=user, kind=SessionKind.ATTACHED, state__in=LIVE_STATES)
    return rows.first()


def live_sessions() -> list[Session]:
    """Returns every session that waits, starts or runs."""
    return list(Session.objects.filter(state__in=LIVE_STATES))


def position(session: Session) -> int | None:
    """Returns the position of a session in the queue, from 1; None if it does not wait."""
    if session.state != SessionState.QUEUED:
        return None
    earlier = Session.objects.filter(
        state=SessionState.QUEUED, kind__in=OF_USERS, created_at__lt=session.created_at
    )
    return earlier.count() + 1


def counts() -> dict[str, int]:
    """Returns the number of sessions that wait, start and run."""
    found = dict(Session.objects.filter(state__in=LIVE_STATES).values_list("state").annotate(n=Count("id")))
    return {state.value: found.get(state.value, 0) for state in LIVE_STATES}


def start_timeout_s(session: Session) -> float:
    """Returns how long the executor of a session may take to start."""
    limits = environment()
    return limits.rayjob_start_timeout_s if session.own_cluster else limits.session_start_timeout_s
