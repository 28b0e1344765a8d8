"""Evaluations and their outcomes. No other app uses the tables; only `writes` writes them."""

from __future__ import annotations

import uuid
from typing import Final

from django.conf import settings
from django.db import models

from backend.evaluations.choices import JobState, Result
from backend.projects.models import Project
from backend.runs.models import Run

MAX_NAME_LENGTH: Final = 100


class Evaluation(models.Model):
    """One evaluation of a revision of a project, by its file `evaluations/<name>.yaml`.

    Attributes:
        older: the revision with which it is compared; it runs in the worlds of `revision`.
        runs: the number of runs that was asked for; 0 is as the file says.
        seed, wanted: the first seed and the number of runs, once they are known.
        sealed: whether tree and actions run in a process that sees nothing of the judge.
        sequential: whether the outcomes decide the number of runs.
        results: by revision, `done`, `wanted`, `rate`, `low` and `high`.
        line_bytes: the size of its outcomes.
        plan: outlines of the world, for the report.
        notes: a line for each part of the project that does not run, such as a launch node.
        attempt: counts how often it was begun.
    """

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="evaluations")
    user = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE, related_name="evaluations")
    name = models.CharField(max_length=MAX_NAME_LENGTH)
    revision = models.PositiveIntegerField()
    older = models.PositiveIntegerField(null=True)
    runs = models.PositiveIntegerField(default=0)
    seed = models.BigIntegerField(null=True)
    wanted = models.PositiveIntegerField(null=True)
    sealed = models.BooleanField(default=False)
    line_bytes = models.BigIntegerField(default=0)
    sequential = models.BooleanField(default=False)
    duration_s = models.FloatField(default=0)
    workers = models.PositiveSmallIntegerField(default=0)
    state = models.CharField(max_length=10, choices=JobState.choices, default=JobState.WAITING)
    error = models.TextField(blank=True)
    results = models.JSONField(default=dict)
    left_s = models.FloatField(null=True)
    plan = models.JSONField(default=dict)
    notes = models.TextField(blank=True, default="", db_default="")
    attempt = models.PositiveIntegerField(default=1)
    tries = models.PositiveSmallIntegerField(default=0)
    created_at = models.DateTimeField()
    asked_at = models.DateTimeField()
    ended_at = models.DateTimeField(null=True)

    class Meta:
        indexes = [models.Index(fields=["project", "-created_at"], name="evaluation_newest")]

    def __str__(self) -> str:
        return self.name


class Outcome(models.Model):
    """The outcome of one run; `line` is its line of `runs.jsonl`."""

    evaluation = models.ForeignKey(Evaluation, on_delete=models.CASCADE, related_name="outcomes")
    revision = models.PositiveIntegerField()
    seed = models.BigIntegerField()
    outcome = models.CharField(max_length=10, choices=Result.choices)
    why = models.TextField(blank=True)
    end_s = models.FloatField()
    margin = models.FloatField(null=True)
    unit = models.CharField(max_length=10, blank=True)
    measures = models.JSONField(default=dict)
    cpu_s = models.FloatField()
    line = models.TextField()
    created_at = models.DateTimeField(db_index=True)

    class Meta:
        constraints = [
            models.UniqueConstraint(fields=["evaluation", "revision", "seed"], name="outcome_unique")
        ]


class Replay(models.Model):
    """A run of an evaluation that is run again by its seed, recorded, and kept as a stored run."""

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    evaluation = models.ForeignKey(Evaluation, on_delete=models.CASCADE, related_name="replays")
    user = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE)
    revision = models.PositiveIntegerField()
    seed = models.BigIntegerField()
    state = models.CharField(max_length=10, choices=JobState.choices, default=JobState.WAITING)
    error = models.TextField(blank=True)
    run = models.ForeignKey(Run, on_delete=models.SET_NULL, null=True)
    tries = models.PositiveSmallIntegerField(default=0)
    created_at = models.DateTimeField()
