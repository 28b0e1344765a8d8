"""Django's entry of this app."""

from django.apps import AppConfig


class AccountsConfig(AppConfig):
    """Users."""

    name = "backend.accounts"
    label = "accounts"

    def ready(self) -> None:
        """Listens to sign-ins, on servers that have them."""
        from backend.config.environment import environment  # noqa: PLC0415

        if environment().is_team:
            from backend.accounts.sign_in import signals  # noqa: PLC0415 - models must be loaded

            signals.connect()
