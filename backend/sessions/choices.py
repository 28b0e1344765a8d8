"""Enumerations of sessions."""

from __future__ import annotations

from django.db import models


class SessionKind(models.TextChoices):
    """What a session is for: a user who looks at it, or an evaluation, which runs without anybody."""

    INTERACTIVE = "interactive"
    EVALUATION = "evaluation"


class SessionState(models.TextChoices):
    """The state of a session: `queued` until a place is free, then `starting`, then `ready` or `failed`.

    A `ready` session becomes `ended`, or `failed` if its process dies.
    """

    QUEUED = "queued"
    STARTING = "starting"
    READY = "ready"
    FAILED = "failed"
    ENDED = "ended"
