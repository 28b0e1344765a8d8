"""Django's entry of this app."""

from django.apps import AppConfig


class ProjectsConfig(AppConfig):
    """Projects."""

    name = "backend.projects"
    label = "projects"
