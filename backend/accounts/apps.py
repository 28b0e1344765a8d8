"""The configuration of this Django app."""

from django.apps import AppConfig


class AccountsConfig(AppConfig):
    """Configuration of the app of users."""

    name = "backend.accounts"
    label = "accounts"

    def ready(self) -> None:
        """Connects the signals of sign-in on servers with accounts."""
        from backend.config.environment import environment  # noqa: PLC0415

        if environment().is_team:
            from backend.accounts.sign_in import signals  # noqa: PLC0415 - models must be loaded

            signals.connect()
