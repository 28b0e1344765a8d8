"""Django's entry of this app."""

from django.apps import AppConfig


class SessionsConfig(AppConfig):
    """Executor sessions; the label differs from that of Django's own sessions."""

    name = "backend.sessions"
    label = "executor_sessions"
