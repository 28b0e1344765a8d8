"""Says to DRF who asks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rest_framework.authentication import BaseAuthentication

from backend.accounts.actions import local_user

if TYPE_CHECKING:
    from rest_framework.request import Request

    from backend.accounts.models import User


class GuardAuthentication(BaseAuthentication):
    """Whatever passed the guard is the local user; the guard has seen cookie or token."""

    def authenticate(self, request: Request) -> tuple[User, None]:
        """Never refuses: `backend.config.middleware.Guard` did before."""
        return local_user(), None

    def authenticate_header(self, request: Request) -> str:
        """The scheme that a 401 names."""
        return "Bearer"
