"""The configuration of this Django app."""

from django.apps import AppConfig


class SessionsConfig(AppConfig):
    """The configuration of the app of executor sessions; its label differs from that of Django's sessions."""

    name = "backend.sessions"
    label = "executor_sessions"
    verbose_name = "Sessions"

    def ready(self) -> None:
        """Connects the deletion of projects and accounts to the end of their sessions."""
        from backend.accounts.rights import lessened  # noqa: PLC0415
        from backend.accounts.signals_out import account_leaves  # noqa: PLC0415
        from backend.projects.signals import project_deleted  # noqa: PLC0415 - models must be loaded
        from backend.sessions.lifecycle.writes import (  # noqa: PLC0415
            end_sessions_of,
            end_sessions_of_user,
            end_sessions_without_right,
        )

        project_deleted.connect(end_sessions_of, dispatch_uid="end_sessions_of")
        lessened.connect(end_sessions_without_right, dispatch_uid="end_sessions_without_right")
        account_leaves.connect(end_sessions_of_user, dispatch_uid="end_sessions_of_user")
