"""The configuration of this Django app."""

from django.apps import AppConfig


class ProjectsConfig(AppConfig):
    """Configuration of the app of projects."""

    name = "backend.projects"
    label = "projects"

    def ready(self) -> None:
        """Connects notices to users who lose a role, and the watch over statements of the database."""
        from backend.core.stale_plans import watch_plans  # noqa: PLC0415 - as below
        from backend.projects.sharing.demotions import watch_roles  # noqa: PLC0415 - models must be loaded

        watch_roles()
        watch_plans()
