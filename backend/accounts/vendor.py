"""allauth's app in local mode, where its tables exist but are not used."""

from __future__ import annotations

from allauth.account.apps import AccountConfig
from django.conf import settings


class Account(AccountConfig):  # type: ignore[misc]
    """The configuration of allauth, whose middleware is required only on servers with accounts."""

    def ready(self) -> None:
        """Sets allauth up on servers with accounts."""
        if settings.ENVIRONMENT.is_team:
            super().ready()
