"""DRF authentication class."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rest_framework.authentication import BaseAuthentication

from backend.accounts.identity import identify

if TYPE_CHECKING:
    from rest_framework.request import Request

    from backend.accounts.models import User


class GuardAuthentication(BaseAuthentication):
    """Identifies the local user on localhost, otherwise the user of the session.

    The guard has already checked the request. There is no CSRF token: the guard refuses requests of other
    sites, and the cookie is SameSite.
    """

    def authenticate(self, request: Request) -> tuple[User, None] | None:
        """Returns the user, or None; `permissions.MayAsk` refuses anonymous requests."""
        user = identify(request.COOKIES)
        return None if user is None else (user, None)

    def authenticate_header(self, request: Request) -> str:
        """Returns the scheme for the header of a 401."""
        return "Bearer"
