"""Reads of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from backend.config.problems import NotFoundError
from backend.sessions.models import LIVE_STATES, Session

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User


def session(session_id: UUID, *, user: User) -> Session:
    """The session, if it is this user's."""
    found = Session.objects.filter(id=session_id, user=user).first()
    if found is None:
        raise NotFoundError("There is no such session.")
    return found


def live_session(project_id: UUID, *, user: User) -> Session | None:
    """The session that runs this project for this user, if one does."""
    return Session.objects.filter(project_id=project_id, user=user, state__in=LIVE_STATES).first()


def live_sessions() -> list[Session]:
    """Every session that starts or runs."""
    return list(Session.objects.filter(state__in=LIVE_STATES))
