"""Permissions that are checked before every view: an account, and limits on expensive calls.

The rights of a user in a project are checked when the project is looked up
(`backend.projects.storage.access`).
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

from django.conf import settings
from rest_framework.permissions import SAFE_METHODS, BasePermission
from rest_framework.throttling import SimpleRateThrottle

from backend.accounts.audit import client_address
from backend.accounts.models import User
from backend.config.environment import environment
from backend.core.clients import network_of
from backend.core.problems import StudioError

if TYPE_CHECKING:
    from rest_framework.request import Request
    from rest_framework.views import APIView


class SignInRequiredError(StudioError):
    """The request has no signed-in user."""

    status = 401
    code = "sign_in_required"
    title = "Sign in first"


class AccountRequiredError(StudioError):
    """A guest with a read-only link tried something that requires an account."""

    status = 403
    code = "account_required"
    title = "This requires an account"


class TeacherRequiredError(StudioError):
    """Only teachers and administrators may manage groups and invitations."""

    status = 403
    code = "teacher_required"
    title = "Not allowed"


class MayAsk(BasePermission):
    """Users may call all views.

    Guests may call views that read projects, and views that are `open_to_guests`.

    Guests may use the methods that read. If the view also has `guests_post`, they may use POST: such a
    request changes nothing, and uses POST only because it is long.
    """

    def has_permission(self, request: Request, view: APIView) -> bool:
        """Returns True if the request is permitted, otherwise raises the error for the user."""
        user = request.user
        if not isinstance(user, User):
            raise SignInRequiredError("Nobody is signed in.", hint="Sign in, then try again.")
        of_project = "project_id" in getattr(view, "kwargs", {})
        is_open = of_project or getattr(view, "open_to_guests", False)
        reads = request.method in SAFE_METHODS or (
            request.method == "POST" and getattr(view, "guests_post", False)
        )
        if user.is_guest and not (reads and is_open):
            raise AccountRequiredError("You opened a read-only link.", hint="Sign in to do this.")
        return True


class ExpensiveCalls(SimpleRateThrottle):
    """Limits the calls per minute of views that are `expensive`, on servers with accounts."""

    scope = "expensive"

    def get_rate(self) -> str:
        """Returns the rate from the environment."""
        return f"{environment().expensive_calls_per_minute}/min"

    def allow_request(self, request: Request, view: APIView) -> bool:
        """Returns whether the user has a call left in this minute."""
        methods: Any = getattr(view, "expensive", ())
        if not environment().is_team or request.method not in methods:
            return True
        return super().allow_request(request, view)

    def get_cache_key(self, request: Request, view: APIView) -> str | None:
        """Returns the key of the count: one for each user; for guests, one for each session."""
        session = request.COOKIES.get(settings.SESSION_COOKIE_NAME, "")
        return f"expensive-{request.user.pk or hashlib.sha256(session.encode()).hexdigest()}"


class ExpensiveCallsOfGuests(ExpensiveCalls):
    """Limits the calls of all guests with one address together, since each guest can open many sessions."""

    def get_rate(self) -> str:
        """Returns ten times the rate of a user, enough for a class."""
        return f"{10 * environment().expensive_calls_per_minute}/min"

    def get_cache_key(self, request: Request, view: APIView) -> str | None:
        """Returns the key of the address for a guest; None for a user, to whom this limit does not apply."""
        return None if request.user.pk else f"guests-{network_of(client_address.get())}"
