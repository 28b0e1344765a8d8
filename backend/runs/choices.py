"""The ways in which a run ends."""

from __future__ import annotations

from django.db.models import TextChoices


class Result(TextChoices):
    """How a run ended: with a fault, with the last result of its root, or before there was one."""

    RUNNING = "running", "Running"
    SUCCESS = "success", "Success"
    FAILURE = "failure", "Failure"
    ERROR = "error", "Error"
