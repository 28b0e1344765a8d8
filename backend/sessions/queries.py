"""Reads of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db.models import Count

from backend.config.environment import environment
from backend.core.problems import NotFoundError
from backend.sessions.choices import OF_USERS, SessionKind
from backend.sessions.models import LIVE_STATES, Session

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User


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


def sessions_of(user: User) -> list[Session]:
    """Returns the sessions of a user that wait, start or run, the oldest first."""
    rows = Session.objects.filter(user=user, kind__in=OF_USERS, state__in=LIVE_STATES)
    return list(rows.select_related("project").order_by("created_at"))


def counts() -> dict[str, int]:
    """Returns the number of sessions that wait, start and run."""
    found = dict(Session.objects.filter(state__in=LIVE_STATES).values_list("state").annotate(n=Count("id")))
    return {state.value: found.get(state.value, 0) for state in LIVE_STATES}


def start_timeout_s(session: Session) -> float:
    """Returns how long the executor of a session may take to start."""
    limits = environment()
    return limits.rayjob_start_timeout_s if session.own_cluster else limits.session_start_timeout_s
