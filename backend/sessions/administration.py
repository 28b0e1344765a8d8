"""The administrator's page of sessions: who runs what, and how to end it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.contrib import admin, messages

from backend.accounts.administration import ReadOnly, site
from backend.accounts.audit import note
from backend.accounts.models import User
from backend.sessions.actions import end_session
from backend.sessions.models import LIVE_STATES, Session

if TYPE_CHECKING:
    from django.db.models import QuerySet
    from django.http import HttpRequest


class Sessions(ReadOnly):
    """Executors, the newest first."""

    list_display = ("created_at", "user", "project", "state", "launcher", "ros_domain_id", "ended_at")
    list_filter = ("state",)
    list_select_related = ("user", "project")
    search_fields = ("user__username", "project__name")
    ordering = ("-created_at",)
    actions = ("end",)
    exclude = ("launcher_state", "address")

    @admin.action(description="End (the user is told)")
    def end(self, request: HttpRequest, rows: QuerySet[Session]) -> None:
        """Ends executors with all their processes."""
        actor = request.user if isinstance(request.user, User) else None
        ended = 0
        for session in rows.filter(state__in=LIVE_STATES).select_related("user"):
            end_session(session)
            note("session.end", actor=actor, subject=session.user.username, subject_id=session.id)
            ended += 1
        messages.success(request, f"Ended: {ended}.")


site.register(Session, Sessions)
