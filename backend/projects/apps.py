"""Django's entry of this app."""

from django.apps import AppConfig


class ProjectsConfig(AppConfig):
    """Configuration of the app of projects."""

    name = "backend.projects"
    label = "projects"

    def ready(self) -> None:
        """Connects the notices to users who lose a role, so that their sockets close."""
        from backend.projects.sharing.demotions import watch_roles  # noqa: PLC0415 - models must be loaded

        watch_roles()
