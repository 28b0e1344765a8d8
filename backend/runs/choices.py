"""The ways in which a run ends."""

from __future__ import annotations

from django.db.models import TextChoices


class Result(TextChoices):
    """The end of a run: with a fault, with the last result of its root, or before there was one."""

    RUNNING = "running", "Running"
    SUCCESS = "success", "Success"
    FAILURE = "failure", "Failure"
    ERROR = "error", "Error"
