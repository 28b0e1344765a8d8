"""Stored runs. No other app uses the tables; only `writes` writes them.

A recording is stored in parts of 1 MiB in the database, or as one object of the object store (`stored_at`).
So it is complete or not there at all, every web server has it, it is in each backup, and it goes with its
project, its user or its row.
"""

from __future__ import annotations

import uuid
from typing import Final

from django.conf import settings
from django.db import models
from django.db.models import Q

from backend.projects.models import Project
from backend.runs.choices import Result

PART_BYTES: Final = 1 << 20
MAX_NAME_LENGTH: Final = 100
MAX_NOTE_LENGTH: Final = 2000


class Run(models.Model):
    """A recording that a user has kept.

    `recorded_as` is the name that its session gave it. `start_s`, `length_s`, `result` and the thumbnail are
    read from the recording. `is_last` marks the last run of its user and project, which is kept by itself.
    """

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="runs")
    keeper = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE, related_name="runs")
    recorded_as = models.CharField(max_length=32)
    name = models.CharField(max_length=MAX_NAME_LENGTH)
    note = models.TextField(blank=True)
    result = models.CharField(max_length=8, choices=Result.choices, default=Result.RUNNING)
    start_s = models.FloatField()
    length_s = models.FloatField()
    size = models.PositiveBigIntegerField()
    sha256 = models.CharField(max_length=64)
    stored_at = models.CharField(max_length=200, null=True)  # noqa: DJ001 - null: it is in parts
    is_pinned = models.BooleanField(default=False)
    is_shared = models.BooleanField(default=False)
    is_last = models.BooleanField(default=False)
    thumbnail = models.BinaryField(default=bytes)
    thumbnail_type = models.CharField(max_length=20, blank=True)
    created_at = models.DateTimeField(db_index=True)

    class Meta:
        constraints = [
            models.UniqueConstraint(
                fields=["project", "keeper"], condition=Q(is_last=True), name="run_last_unique"
            )
        ]

    def __str__(self) -> str:
        return self.name


class RunPart(models.Model):
    """A part of a recording; all but the last have `PART_BYTES`."""

    run = models.ForeignKey(Run, on_delete=models.CASCADE, related_name="parts")
    number = models.PositiveIntegerField()
    data = models.BinaryField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["run", "number"], name="run_part_unique")]
