"""Reads of evaluations. All who may read a project see its evaluations."""

from __future__ import annotations

import contextlib
from datetime import timedelta
from typing import TYPE_CHECKING, Any, Final

import msgspec
from django.db.models import Avg, Count, Sum
from django.db.models.functions import Length
from django.utils import timezone

from backend.core.problems import NotFoundError
from backend.evaluations.models import Evaluation, Outcome, Replay
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need

if TYPE_CHECKING:
    from collections.abc import Iterator
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project

FOLDER: Final = "evaluations/"
ENDING: Final = ".yaml"
OUTCOMES_AT_A_TIME: Final = 2000
OUTCOME_BYTES_AT_A_TIME: Final = 8 << 20
MOST_NODES: Final = 20_000
_DAY: Final = timedelta(hours=24)


def evaluations(project_id: UUID, *, user: User) -> tuple[Project, list[Evaluation]]:
    """Returns a project, and its evaluations, the newest first."""
    project = projects.project(project_id, user=user, need=Need.READ)
    rows = Evaluation.objects.filter(project=project).select_related("user").defer("plan")
    return project, list(rows.order_by("-created_at", "id"))


def evaluation(
    project_id: UUID, evaluation_id: UUID, *, user: User, need: Need = Need.READ, has_plan: bool = False
) -> Evaluation:
    """Returns one evaluation.

    Raises:
        NotFoundError: the project or the evaluation does not exist, or the user may not know of it.
        RoleTooLowError: the user's role in the project does not suffice.
    """
    project = projects.project(project_id, user=user, need=need)
    rows = Evaluation.objects.filter(project=project, id=evaluation_id).select_related("user")
    found = (rows if has_plan else rows.defer("plan")).first()
    if found is None:
        raise NotFoundError("There is no such evaluation.")
    found.project = project
    return found


def counts(found: list[Evaluation]) -> dict[tuple[UUID, int], dict[str, int]]:
    """Returns how often each outcome occurs, by evaluation and revision."""
    rows = Outcome.objects.filter(evaluation__in=found).values_list("evaluation", "revision", "outcome")
    by: dict[tuple[UUID, int], dict[str, int]] = {}
    for evaluation_id, revision, outcome, number in rows.annotate(number=Count("id")):
        by.setdefault((evaluation_id, revision), {})[outcome] = number
    return by


def line_bytes(project_id: UUID) -> int:
    """Returns the size of all outcomes of a project's evaluations."""
    rows = Evaluation.objects.filter(project=project_id)
    return rows.aggregate(size=Sum("line_bytes"))["size"] or 0


def costs(rows: list[Evaluation]) -> list[dict[str, Any]]:
    """Returns what a run takes, by the last of these evaluations of each name that has outcomes."""
    last: dict[str, Evaluation] = {}
    for row in rows:
        if row.results and not row.sealed:
            last.setdefault(row.name, row)
    means = Outcome.objects.filter(evaluation__in=last.values()).values_list("evaluation")
    by_id = dict(means.annotate(mean=Avg("cpu_s")).values_list("evaluation", "mean"))
    return [
        {"name": name, "cpu_s": by_id[row.id], "workers": max(row.workers, 1)}
        for name, row in last.items()
        if row.id in by_id
    ]


def outcomes(found: Evaluation, revision: int, after: int) -> list[Outcome]:
    """Returns the outcomes that came after a row, in the order in which they came.

    They are at most 2,000, whose lines have at most 8 MB; their measures are parts of their lines.
    """
    rows = Outcome.objects.filter(evaluation=found, revision=revision, id__gt=after).defer("line")
    page: list[Outcome] = []
    left = OUTCOME_BYTES_AT_A_TIME
    sized = rows.annotate(line_size=Length("line")).order_by("id")[:OUTCOMES_AT_A_TIME]
    for row in sized.iterator(chunk_size=100):
        left -= row.line_size
        if left < 0 and page:
            break
        page.append(row)
    return page


def outcome(found: Evaluation, revision: int, seed: int) -> Outcome:
    """Returns the outcome of a seed."""
    row = Outcome.objects.filter(evaluation=found, revision=revision, seed=seed).first()
    if row is None:
        raise NotFoundError(f"The evaluation has no outcome of the seed {seed}.")
    return row


def known(found: Evaluation, revision: int) -> list[tuple[int, str]]:
    """Returns the seeds that have an outcome, each with it."""
    rows = Outcome.objects.filter(evaluation=found, revision=revision)
    return list(rows.order_by("seed").values_list("seed", "outcome"))


def lines(found: Evaluation, revision: int) -> Iterator[str]:
    """Yields the lines of `runs.jsonl`, in the order of the seeds."""
    rows = Outcome.objects.filter(evaluation=found, revision=revision).order_by("seed")
    return rows.values_list("line", flat=True).iterator(chunk_size=200)


class _Seen(msgspec.Struct):
    seen: dict[str, str] = {}


def seen(found: Evaluation, revision: int) -> dict[str, str]:
    """Returns all results that each node had in some run, as letters by the path of the node.

    They are those of the first `MOST_NODES` nodes.
    """
    decoder = msgspec.json.Decoder(_Seen)
    every: dict[str, set[str]] = {}
    for line in lines(found, revision):
        with contextlib.suppress(msgspec.DecodeError):  # the executor wrote it, which runs code of users
            for path, letters in decoder.decode(line).seen.items():
                if path in every or len(every) < MOST_NODES:
                    every.setdefault(path, set()).update(letters)
    return {path: "".join(sorted(letters)) for path, letters in every.items()}


def replay(found: Evaluation, replay_id: UUID, *, user: User) -> Replay:
    """Returns a replay that the user has asked for."""
    rows = Replay.objects.filter(id=replay_id, evaluation=found)
    row = None if user.is_guest else rows.filter(user=user).first()
    if row is None:
        raise NotFoundError("There is no such replay.")
    return row


def used_hours(user: User) -> float:
    """Returns the processor hours that evaluations of a user took in the last 24 hours."""
    rows = Outcome.objects.filter(evaluation__user=user, created_at__gt=timezone.now() - _DAY)
    return float(rows.aggregate(used=Sum("cpu_s"))["used"] or 0) / 3600
