"""Permissions that are checked before every view: an account, and limits on expensive calls.

What someone may do with a project is decided where projects are found (`backend.projects.storage.access`).
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
    """Nobody is signed in."""

    status = 401
    code = "sign_in_required"
    title = "Sign in first"


class AccountRequiredError(StudioError):
    """A guest, who came by a read-only link, wants something that takes an account."""

    status = 403
    code = "account_required"
    title = "This takes an account"


class TeacherRequiredError(StudioError):
    """Groups and invitations are for teachers and administrators."""

    status = 403
    code = "teacher_required"
    title = "Not allowed"


class MayAsk(BasePermission):
    """Users may ask anything; guests may read projects, and what a view says is `open_to_guests`.

    Of such a view they may use the methods that read, and POST where it says `guests_post`: what is asked
    with a body because it is long, and changes nothing.
    """

    def has_permission(self, request: Request, view: APIView) -> bool:
        """Raises the error that the user sees."""
        user = request.user
        if not isinstance(user, User):
            raise SignInRequiredError("Nobody is signed in.", hint="Sign in, then try again.")
        of_project = "project_id" in getattr(view, "kwargs", {})
        is_open = of_project or getattr(view, "open_to_guests", False)
        reads = request.method in SAFE_METHODS or (
            request.method == "POST" and getattr(view, "guests_post", False)
        )
        if user.is_guest and not (reads and is_open):
            raise AccountRequiredError("You came by a read-only link.", hint="Sign in to do this.")
        return True


class ExpensiveCalls(SimpleRateThrottle):
    """Bounds the calls a minute to views that say they are `expensive`; on team servers only."""

    scope = "expensive"

    def get_rate(self) -> str:
        """From the environment."""
        return f"{environment().expensive_calls_per_minute}/min"

    def allow_request(self, request: Request, view: APIView) -> bool:
        """Whether there is a call left."""
        methods: Any = getattr(view, "expensive", ())
        if not environment().is_team or request.method not in methods:
            return True
        return super().allow_request(request, view)

    def get_cache_key(self, request: Request, view: APIView) -> str | None:
        """One count a user; of guests, one a session."""
        session = request.COOKIES.get(settings.SESSION_COOKIE_NAME, "")
        return f"expensive-{request.user.pk or hashlib.sha256(session.encode()).hexdigest()}"


class ExpensiveCallsOfGuests(ExpensiveCalls):
    """Bounds those of all guests behind one address, who get as many sessions as they ask for."""

    def get_rate(self) -> str:
        """For a class of them."""
        return f"{10 * environment().expensive_calls_per_minute}/min"

    def get_cache_key(self, request: Request, view: APIView) -> str | None:
        """None for users, whom this does not bound."""
        return None if request.user.pk else f"guests-{network_of(client_address.get())}"
