"""The ways in which a run ends."""

from __future__ import annotations

from django.db.models import TextChoices


class Result(TextChoices):
    """The end of a run as the page reported it; it proves nothing."""

    RUNNING = "running", "Running"
    SUCCESS = "success", "Success"
    FAILURE = "failure", "Failure"
    ERROR = "error", "Error"
