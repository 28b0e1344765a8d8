"""Django's entry of this app."""

from django.apps import AppConfig


class ProjectsConfig(AppConfig):
    """Projects."""

    name = "backend.projects"
    label = "projects"

    def ready(self) -> None:
        """Connects the notices to users who lose a role: they must not continue to listen."""
        from backend.projects.sharing.demotions import watch_roles  # noqa: PLC0415 - models must be loaded

        watch_roles()
