"""Django's entry of this app."""

from django.apps import AppConfig


class AccountsConfig(AppConfig):
    """Users."""

    name = "backend.accounts"
    label = "accounts"
