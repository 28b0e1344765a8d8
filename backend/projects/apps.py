"""The configuration of this Django app."""

from django.apps import AppConfig


class ProjectsConfig(AppConfig):
    """Configuration of the app of projects."""

    name = "backend.projects"
    label = "projects"

    def ready(self) -> None:
        """Connects notices to users who lose a role, so that their sockets are closed."""
        from backend.projects.sharing.demotions import watch_roles  # noqa: PLC0415 - models must be loaded

        watch_roles()
