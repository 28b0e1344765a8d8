"""The administration page of sessions: who runs which project, and a button that ends a session."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from django.contrib import admin, messages
from django.http import HttpRequest, HttpResponse, HttpResponseRedirect
from django.urls import path, reverse

from backend.accounts.administration import ReadOnly, site
from backend.accounts.audit import note
from backend.accounts.models import User
from backend.sessions import queries
from backend.sessions.lifecycle import drain
from backend.sessions.lifecycle.writes import end_session
from backend.sessions.models import LIVE_STATES, Session

if TYPE_CHECKING:
    from django.db.models import QuerySet


class Sessions(ReadOnly):
    """All executors of the server, the newest first."""

    list_display = (
        "created_at",
        "user",
        "kind",
        "project",
        "target",
        "state",
        "launcher",
        "ros_domain_id",
        "ended_at",
    )
    list_filter = ("state",)
    list_select_related = ("user", "project")
    search_fields = ("user__username", "project__name")
    ordering = ("-created_at",)
    actions = ("end",)
    exclude = ("launcher_state", "address")
    change_list_template = "admin/sessions.html"

    def get_urls(self) -> list[Any]:
        """Adds the address of the button that prevents robots from starting."""
        button = path("drain/", self.admin_site.admin_view(self.drain), name="drain")
        return [button, *super().get_urls()]

    def changelist_view(self, request: HttpRequest, extra_context: dict[str, Any] | None = None) -> Any:
        """Shows the list with the number of running sessions, and whether more may start."""
        more = {"drain": drain.current(), "counts": queries.counts()}
        return super().changelist_view(request, more | (extra_context or {}))

    def drain(self, request: HttpRequest) -> HttpResponse:
        """Prevents robots from starting, or allows it again."""
        actor = request.user if isinstance(request.user, User) else None
        if request.method == "POST" and "off" in request.POST:
            drain.lift(acting_user=actor)
            messages.success(request, "Robots start again.")
        elif request.method == "POST":
            drain.begin(request.POST.get("message", ""), acting_user=actor)
            messages.success(request, "No robot starts any more, and users are notified.")
        return HttpResponseRedirect(reverse("admin:executor_sessions_session_changelist"))

    @admin.action(description="End (the user is notified)")
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
