"""Enumerations of sessions."""

from __future__ import annotations

from django.db import models


class SessionState(models.TextChoices):
    """`queued` until a place is free; `starting` becomes `ready` or `failed`.

    `ready` becomes `ended`, or `failed` when the process dies.
    """

    QUEUED = "queued"
    STARTING = "starting"
    READY = "ready"
    FAILED = "failed"
    ENDED = "ended"
