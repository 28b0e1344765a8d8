"""DRF authentication class."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rest_framework.authentication import BaseAuthentication

from backend.accounts.identity import identify

if TYPE_CHECKING:
    from rest_framework.request import Request

    from backend.accounts.models import User


class GuardAuthentication(BaseAuthentication):
    """On localhost whatever passed the guard is the local user; else the session tells.

    No CSRF token is asked for: the guard refuses what comes from other sites, and the cookie is SameSite.
    """

    def authenticate(self, request: Request) -> tuple[User, None] | None:
        """Never refuses: `permissions.MayAsk` does."""
        user = identify(request.COOKIES)
        return None if user is None else (user, None)

    def authenticate_header(self, request: Request) -> str:
        """The scheme that a 401 names."""
        return "Bearer"
