"""Django's entry of this app."""

from django.apps import AppConfig


class AccountsConfig(AppConfig):
    """Users."""

    name = "backend.accounts"
    label = "accounts"

    def ready(self) -> None:
        """Registers the description of the authentication."""
        from backend.accounts import schema  # noqa: F401, PLC0415 - importing it registers it
