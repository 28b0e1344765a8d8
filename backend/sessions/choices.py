"""Enumerations of sessions."""

from __future__ import annotations

from typing import Final

from django.db import models


class SessionKind(models.TextChoices):
    """The purpose of a session: a user works in it, evaluations run in it, or it follows another program."""

    INTERACTIVE = "interactive"
    EVALUATION = "evaluation"
    ATTACHED = "attached"


OF_USERS: Final = (SessionKind.INTERACTIVE, SessionKind.ATTACHED)
"""The kinds of sessions that a page works in."""


class SessionState(models.TextChoices):
    """The state of a session: `queued` until a place is free, then `starting`, then `ready` or `failed`.

    A `ready` session becomes `ended`, or `failed` if its process dies.
    """

    QUEUED = "queued"
    STARTING = "starting"
    READY = "ready"
    FAILED = "failed"
    ENDED = "ended"
