"""allauth's app as it is in local mode, where its tables exist and nothing of it is used."""

from __future__ import annotations

from allauth.account.apps import AccountConfig
from django.conf import settings


class Account(AccountConfig):  # type: ignore[misc]
    """Asks for its middleware only where its pages exist."""

    def ready(self) -> None:
        """As allauth does, on servers with accounts."""
        if settings.ENVIRONMENT.is_team:
            super().ready()
