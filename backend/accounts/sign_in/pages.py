"""Pages outside of the IDE: accepting an invitation, opening a read-only link, refusals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from django.contrib import messages
from django.http import HttpRequest, HttpResponse, HttpResponseRedirect
from django.shortcuts import render
from django.views.decorators.cache import never_cache
from django.views.decorators.http import require_http_methods

from backend.accounts import invitations
from backend.accounts.models import User
from backend.accounts.texts import text
from backend.config.environment import environment

if TYPE_CHECKING:
    from backend.accounts.models import Invitation


def context(request: HttpRequest) -> dict[str, Any]:
    """Returns the values that all templates use."""
    settings = environment()
    return {
        "registration_open": settings.registration == "open",
        "sends_mail": bool(settings.smtp_url.get_secret_value()),
        "single_sign_on": bool(settings.oidc_issuer),
    }


@never_cache
@require_http_methods(["GET", "POST"])
def join(request: HttpRequest, token: str) -> HttpResponse:
    """Accepts an invitation: a signed-in user joins with a button, others sign up or sign in first."""
    found = invitations.of_token(token)
    if found is None:
        return dead_link(request)
    request.session[invitations.SESSION_KEY] = token
    user = request.user
    if not isinstance(user, User):
        return _render_join(request, found, next_page=request.path)
    if request.method == "POST":
        group = invitations.accept(token, acting_user=user, new_account=False)
        request.session.pop(invitations.SESSION_KEY, None)
        if group is not None:
            messages.success(request, text("joined", group=group.name))
        return HttpResponseRedirect("/")
    return _render_join(request, found, next_page=request.path)


def _render_join(request: HttpRequest, found: Invitation, *, next_page: str) -> HttpResponse:
    return render(
        request,
        "accounts/join.html",
        {
            "invitation": found,
            "who": found.created_by.get_full_name() or found.created_by.username,
            "next": urlencode({"next": next_page}),
        },
    )


def dead_link(request: HttpRequest) -> HttpResponse:
    """Shows the page for an invalid link: expired, revoked, or not copied completely."""
    values = {"title": text("link_dead_title"), "sentence": text("link_dead")}
    return render(request, "accounts/message.html", values, status=404)


def csrf_failure(request: HttpRequest, reason: str = "") -> HttpResponse:
    """Shows the page for a form without its token."""
    values = {"title": text("csrf_title"), "sentence": text("csrf")}
    return render(request, "accounts/message.html", values, status=403)
