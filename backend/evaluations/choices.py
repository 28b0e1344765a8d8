"""Enumerations of evaluations."""

from __future__ import annotations

from typing import Final

from django.db.models import TextChoices


class JobState(TextChoices):
    """The state of an evaluation: `waiting` for its turn, `running`, and then one of the others.

    A cancelled or failed one waits again when it is resumed.
    """

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    CANCELLED = "cancelled"
    FAILED = "failed"


class Result(TextChoices):
    """The outcome of a run; the last three say nothing of the project and are not counted."""

    SUCCESS = "success"
    FAILURE = "failure"
    ERROR = "error"
    CRASHED = "crashed"
    TIMEOUT = "timeout"
    INVALID = "invalid"
    LOST = "lost"
    CANCELLED = "cancelled"


class WaitsFor(TextChoices):
    """The reason for which an evaluation waits: processor hours, users who work, its turn, or its cluster."""

    NOTHING = "", "nothing"
    HOURS = "hours"
    USERS = "users"
    TURN = "turn"
    CLUSTER = "cluster"


class Obstacle(TextChoices):
    """The reason for which nobody can start an evaluation of a project."""

    NONE = "", "nothing"
    ONE_PLACE = "one_place", "This server has one place for robots, and that is kept for users who work."
    ARCHIVED = "archived", "The project is archived."


LIVE: Final = (JobState.WAITING, JobState.RUNNING)
NOT_COUNTED: Final = (Result.INVALID, Result.LOST, Result.CANCELLED)
