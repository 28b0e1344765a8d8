"""Closed sets of the sessions app."""

from __future__ import annotations

from django.db import models


class SessionState(models.TextChoices):
    """`queued` until there is a place; `starting` becomes `ready` or `failed`.

    `ready` becomes `ended`, or `failed` when the process dies.
    """

    QUEUED = "queued"
    STARTING = "starting"
    READY = "ready"
    FAILED = "failed"
    ENDED = "ended"
