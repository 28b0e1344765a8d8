"""Gives warm executors to sessions. An executor has one session, whatever happens to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from backend.sessions.launchers.base import WARM, Started
from backend.sessions.models import WarmExecutor

if TYPE_CHECKING:
    from uuid import UUID

    from backend.sessions.launchers.base import Launcher
    from backend.sessions.models import Session

__all__ = ["claim", "key_of"]


def claim(session_id: UUID, launcher: Launcher) -> Started | None:
    """Returns a warm executor that now belongs to a session; None if none runs.

    Several web servers may call it at the same time: the row decides. The launcher is asked for what it knows
    alone, so that nothing waits for a cluster.
    """
    if not launcher.keeps_warm:
        return None
    free = WarmExecutor.objects.filter(claimed_by=None).exclude(address="").order_by("created_at")
    for found in free:
        if launcher.poll(found.launcher_state) is not None:
            continue
        if WarmExecutor.objects.filter(id=found.id, claimed_by=None).update(claimed_by=session_id):
            return Started(found.address, {**found.launcher_state, WARM: str(found.id)})
    return None


def key_of(session: Session) -> str:
    """Returns the id from which the token of a session's manager is derived."""
    return str(session.launcher_state.get(WARM) or session.id)
