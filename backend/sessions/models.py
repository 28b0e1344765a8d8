"""Sessions, executors that wait for one, leases and the drain."""

from __future__ import annotations

import uuid

from django.conf import settings
from django.db import models
from django.db.models import Q

from backend.sessions.choices import SessionKind, SessionState

RUNNING_STATES = (SessionState.STARTING, SessionState.READY)
LIVE_STATES = (SessionState.QUEUED, *RUNNING_STATES)


class Drain(models.Model):
    """A drain: while this row exists, no robot starts before an upgrade. There is at most one."""

    since = models.DateTimeField()
    message = models.CharField(max_length=300, blank=True)


class Lease(models.Model):
    """The web server that does a task for all servers, and the time until which it does it (`lease.py`)."""

    name = models.CharField(max_length=40, primary_key=True)
    owner = models.CharField(max_length=100)
    until = models.DateTimeField()


class WarmExecutor(models.Model):
    """An executor that was started ahead of a session, which a session claims; it is never given back.

    `claimed_by` is no foreign key: an executor whose session's row is deleted stays claimed.
    """

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    address = models.CharField(max_length=200, blank=True)
    launcher_state = models.JSONField(default=dict)
    created_at = models.DateTimeField()
    claimed_by = models.UUIDField(null=True)


class Session(models.Model):
    """One executor: a manager with its world and its application.

    A project has at most one live session of each kind for each user. An attached one has no project, and
    follows the program at `target` (HOST:PORT); a user has at most one for each program.
    """

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    project = models.ForeignKey(
        "projects.Project", on_delete=models.CASCADE, related_name="sessions", null=True
    )
    user = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE)
    kind = models.CharField(max_length=16, choices=SessionKind.choices, default=SessionKind.INTERACTIVE)
    target = models.CharField(max_length=260, blank=True, default="")
    state = models.CharField(max_length=16, choices=SessionState.choices, default=SessionState.STARTING)
    launcher = models.CharField(max_length=32)
    launcher_state = models.JSONField(default=dict)
    address = models.CharField(max_length=200, blank=True)
    # Whether it is an evaluation with a Ray cluster of its own.
    own_cluster = models.BooleanField(default=False, db_default=False)
    ros_domain_id = models.PositiveSmallIntegerField(null=True)
    error = models.TextField(blank=True)
    created_at = models.DateTimeField()
    ended_at = models.DateTimeField(null=True)
    used_at = models.DateTimeField(null=True)

    class Meta:
        constraints = [
            models.UniqueConstraint(
                fields=["project", "user", "kind"],
                condition=Q(state__in=LIVE_STATES),
                name="session_live_unique",
            ),
            models.UniqueConstraint(
                fields=["user", "target"],
                condition=Q(state__in=LIVE_STATES, kind=SessionKind.ATTACHED),
                name="session_target_unique",
            ),
            models.CheckConstraint(
                condition=Q(kind=SessionKind.ATTACHED, project=None)
                | (~Q(kind=SessionKind.ATTACHED) & Q(project__isnull=False)),
                name="session_project_or_target",
            ),
            models.UniqueConstraint(
                fields=["ros_domain_id"], condition=Q(state__in=LIVE_STATES), name="session_domain_unique"
            ),
        ]
