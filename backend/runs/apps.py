"""The configuration of this Django app."""

from django.apps import AppConfig


class RunsConfig(AppConfig):
    """The configuration of the app of stored runs."""

    name = "backend.runs"
    label = "runs"
    verbose_name = "Runs"
