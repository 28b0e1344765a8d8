"""The configuration of this Django app."""

from django.apps import AppConfig


class RunsConfig(AppConfig):
    """The configuration of the app of stored runs."""

    name = "backend.runs"
    label = "runs"
    verbose_name = "Runs"

    def ready(self) -> None:
        """Connects the end of sessions to the last run that is kept."""
        from backend.runs.last import fetch_last, sweep_soon  # noqa: PLC0415 - models must be loaded
        from backend.sessions.signals import session_ends, sessions_maintained  # noqa: PLC0415

        session_ends.connect(fetch_last, dispatch_uid="fetch_last")
        sessions_maintained.connect(sweep_soon, dispatch_uid="sweep_soon")
