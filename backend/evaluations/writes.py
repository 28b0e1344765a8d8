"""All writes to evaluations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from django.db import transaction
from django.db.models import Sum
from django.db.models.functions import Length
from django.utils import timezone

from backend.config.environment import environment
from backend.core.locks import transaction_lock
from backend.evaluations import queries
from backend.evaluations.choices import LIVE, NOT_COUNTED, JobState, Obstacle
from backend.evaluations.errors import (
    ArchivedError,
    NoEvaluationError,
    NothingEvaluatedError,
    NotOlderError,
    OnePlaceError,
    OutcomesFullError,
    RunsAlreadyError,
    TooManyWaitError,
)
from backend.evaluations.models import Evaluation, Outcome, Replay
from backend.evaluations.queries import ENDING, FOLDER
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.sessions.lifecycle.writes import has_room_for_evaluations
from translator.limits import megabytes

if TYPE_CHECKING:
    from collections.abc import Sequence
    from uuid import UUID

    from backend.accounts.models import User
    from backend.evaluations.executor_events import Begun, Done, Line
    from backend.projects.models import Project
    from backend.runs.models import Run

MOST_KEPT: Final = 50
MOST_WAITING: Final = 20
MOST_ERROR: Final = 20_000
MOST_WHY: Final = 2000
MOST_TRIES: Final = 3
DELETE_SOME: Final = "Delete an older evaluation of the project, then run the rest."
_REFUSALS: Final = {
    Obstacle.ONE_PLACE: (OnePlaceError, "Use `bt-studio evaluate` on the command line."),
    Obstacle.ARCHIVED: (ArchivedError, "Take it out of the archive first."),
}
_TURN: Final = "evaluations of {}"


def why_not(project: Project) -> Obstacle:
    """Returns why nobody can start an evaluation of a project; `NONE` if one can."""
    if not has_room_for_evaluations():
        return Obstacle.ONE_PLACE
    return Obstacle.ARCHIVED if project.archived_at else Obstacle.NONE


def start(project_id: UUID, name: str, runs: int, *, acting_user: User, sealed: bool = False) -> Evaluation:
    """Puts an evaluation of the current revision of a project into the queue.

    Raises:
        RoleTooLowError: the user may not change the project.
        NoEvaluationError: there is no such evaluation, or this server runs none.
        TooManyWaitError: too many evaluations of the project wait.
    """
    with transaction.atomic():
        project = projects.project(project_id, user=acting_user, need=Need.WRITE)
        transaction_lock(_TURN.format(project.id))
        _require_possible(project)
        if f"{FOLDER}{name}{ENDING}" not in projects.existing_files(project):
            raise NoEvaluationError(
                f"The project has no evaluation “{name}”.", hint=f"Save it as {FOLDER}{name}{ENDING}."
            )
        _require_room(project)
        if Evaluation.objects.filter(project=project, state__in=LIVE).count() >= MOST_WAITING:
            raise TooManyWaitError(
                f"{MOST_WAITING} evaluations of this project wait or run.", hint="Cancel one of them first."
            )
        now = timezone.now()
        made = Evaluation.objects.create(
            project=project,
            user=acting_user,
            name=name,
            revision=project.revision,
            runs=runs,
            sealed=sealed,
            created_at=now,
            asked_at=now,
        )
        rows = Evaluation.objects.filter(project=project).order_by("-created_at", "id")
        for old in rows.exclude(state__in=LIVE).defer("plan")[MOST_KEPT - 1 :]:
            if old.pk != made.pk:
                old.delete()
    return made


def cancel(project_id: UUID, evaluation_id: UUID, *, acting_user: User) -> Evaluation:
    """Ends an evaluation; what is done is kept."""
    found = queries.evaluation(project_id, evaluation_id, user=acting_user, need=Need.WRITE)
    rows = Evaluation.objects.filter(id=found.id, state__in=LIVE)
    rows.update(state=JobState.CANCELLED, left_s=None, ended_at=timezone.now())
    return queries.evaluation(project_id, evaluation_id, user=acting_user)


def resume(project_id: UUID, evaluation_id: UUID, *, acting_user: User) -> Evaluation:
    """Runs what an evaluation lacks. Runs that said nothing of the project are run again.

    Raises:
        RunsAlreadyError: it runs already.
    """
    return _begin_again(project_id, evaluation_id, {}, acting_user)


def compare(project_id: UUID, evaluation_id: UUID, older: int, *, acting_user: User) -> Evaluation:
    """Runs the same seeds with an older revision, in the same worlds.

    Raises:
        NothingEvaluatedError: the evaluation has no outcome yet.
        NotOlderError: the revision is not older.
    """
    found = queries.evaluation(project_id, evaluation_id, user=acting_user, need=Need.WRITE)
    projects.change_set(found.project, older)
    if older >= found.revision:
        raise NotOlderError(
            f"Revision {older} is not older than {found.revision}, which was evaluated.",
            hint="Choose an older revision.",
        )
    if not found.results.get(str(found.revision), {}).get("done"):
        raise NothingEvaluatedError("Nothing was evaluated yet.", hint="Evaluate first, then compare.")
    return _begin_again(project_id, evaluation_id, {"older": older}, acting_user)


@transaction.atomic
def _begin_again(
    project_id: UUID, evaluation_id: UUID, changes: dict[str, Any], acting_user: User
) -> Evaluation:
    found = queries.evaluation(project_id, evaluation_id, user=acting_user, need=Need.WRITE)
    transaction_lock(_TURN.format(found.project_id))
    _require_possible(found.project)
    values = {
        "state": JobState.WAITING,
        "error": "",
        "ended_at": None,
        "attempt": found.attempt + 1,
        "tries": 0,
        "asked_at": timezone.now(),
        "user": acting_user,
    }
    rows = Evaluation.objects.filter(id=found.id, attempt=found.attempt).exclude(state__in=LIVE)
    if not rows.update(**values, **changes):
        raise RunsAlreadyError("The evaluation runs already.", hint="Wait for its end, or cancel it.")
    Outcome.objects.filter(evaluation=found, outcome__in=NOT_COUNTED).delete()
    if "older" in changes and found.older not in (None, changes["older"]):
        Outcome.objects.filter(evaluation=found, revision=found.older).delete()
    _measure(found.id)
    _require_room(found.project)
    return queries.evaluation(project_id, evaluation_id, user=acting_user)


def delete(project_id: UUID, evaluation_id: UUID, *, acting_user: User) -> None:
    """Deletes an evaluation with its outcomes; one that runs ends."""
    queries.evaluation(project_id, evaluation_id, user=acting_user, need=Need.WRITE).delete()


@transaction.atomic
def ask_replay(
    project_id: UUID, evaluation_id: UUID, revision: int, seed: int, *, acting_user: User
) -> Replay:
    """Asks for a run to be run again and recorded; an earlier replay of it that still exists is returned."""
    found = queries.evaluation(project_id, evaluation_id, user=acting_user, need=Need.RUN)
    _require_possible(found.project)
    queries.outcome(found, revision, seed)
    transaction_lock(_TURN.format(found.project_id))
    mine = Replay.objects.filter(evaluation=found, user=acting_user, revision=revision, seed=seed)
    same = mine.filter(state__in=LIVE).first() or mine.filter(state=JobState.DONE).exclude(run=None).first()
    if same is not None:
        return same
    Replay.objects.filter(user=acting_user, state=JobState.WAITING).delete()  # the last click counts
    return Replay.objects.create(
        evaluation=found, user=acting_user, revision=revision, seed=seed, created_at=timezone.now()
    )


def cancel_replay(project_id: UUID, evaluation_id: UUID, replay_id: UUID, *, acting_user: User) -> None:
    """Takes the wish for a replay back; one that runs ends. What is recorded already stays."""
    found = queries.evaluation(project_id, evaluation_id, user=acting_user, need=Need.RUN)
    queries.replay(found, replay_id, user=acting_user).delete()


def begun(found: Evaluation, event: Begun) -> None:
    """Stores what is known of an evaluation once it has begun."""
    values: dict[str, Any] = {"state": JobState.RUNNING, "workers": event.workers}
    if found.seed is None:
        values |= {"seed": event.seed, "wanted": event.wanted, "sequential": event.sequential}
        values |= {"duration_s": event.duration_s, "plan": event.plan, "notes": event.notes}
    if Evaluation.objects.filter(id=found.id, state__in=LIVE).update(**values):
        for name, value in values.items():
            setattr(found, name, value)


def continues(found: Evaluation) -> None:
    """Stores that an evaluation that has begun before runs again."""
    Evaluation.objects.filter(id=found.id, state__in=LIVE).update(state=JobState.RUNNING)


@transaction.atomic
def store(found: Evaluation, revision: int, received: Sequence[tuple[Done, Line]]) -> bool:
    """Stores outcomes; those that are stored already stay. Returns whether the evaluation is still wanted."""
    locked = Evaluation.objects.select_for_update().filter(id=found.id).defer("plan").first()
    if locked is None:
        return False
    now = timezone.now()
    Outcome.objects.bulk_create(
        [Outcome(**_outcome(locked, revision, done, line), created_at=now) for done, line in received],
        ignore_conflicts=True,
    )
    if received:
        last = received[-1][0]
        about = {name: getattr(last, name) for name in ("done", "wanted", "rate", "low", "high")}
        locked.results = {**locked.results, str(revision): about}
        locked.left_s, locked.tries = last.left_s, 0
        locked.line_bytes += sum(len(done.line) for done, _ in received)
        locked.save(update_fields=["results", "left_s", "tries", "line_bytes"])
        if locked.state in LIVE and (text := _size_problem(locked.project_id)):
            finish(locked, JobState.FAILED, f"{text} What is done is kept. {DELETE_SOME}")
            return False
    return locked.state in LIVE and locked.attempt == found.attempt


def _size_problem(project_id: UUID) -> str:
    """Returns what is wrong with the size of the outcomes of a project; "" if it is within its bound."""
    used = queries.line_bytes(project_id)
    limit = environment().max_outcome_bytes
    if used < limit:
        return ""
    return f"The outcomes of this project's evaluations take {megabytes(used)} of {megabytes(limit)}."


def _measure(evaluation_id: UUID) -> None:
    size = Outcome.objects.filter(evaluation=evaluation_id).aggregate(size=Sum(Length("line")))["size"]
    Evaluation.objects.filter(id=evaluation_id).update(line_bytes=size or 0)


def _require_room(project: Project) -> None:
    if text := _size_problem(project.id):
        raise OutcomesFullError(text, hint=DELETE_SOME)


def _outcome(found: Evaluation, revision: int, done: Done, line: Line) -> dict[str, Any]:
    nearest = line.nearest
    return {
        "evaluation": found,
        "revision": revision,
        "seed": line.seed,
        "outcome": line.outcome,
        "why": line.why[:MOST_WHY],
        "end_s": line.end_s,
        "margin": nearest.margin if nearest is not None else None,
        "unit": nearest.unit if nearest is not None else "",
        "measures": line.measures,
        "cpu_s": done.cpu_s,
        "line": done.line.replace("\0", ""),
    }


@transaction.atomic
def side_done(found: Evaluation, revision: int, wanted: int) -> None:
    """Stores that all runs of a revision are done: what was run beyond the end that `until` chose goes."""
    locked = Evaluation.objects.select_for_update().filter(id=found.id).defer("plan").first()
    if locked is None:
        return
    known = queries.known(locked, revision)
    if revision == locked.revision and locked.sequential and wanted < len(known):
        kept = [seed for seed, _ in known][:wanted]
        Outcome.objects.filter(evaluation=locked, revision=revision, seed__gt=kept[-1]).delete()
    about = locked.results.get(str(revision), {}) | {"done": min(wanted, len(known)), "wanted": wanted}
    locked.results = {**locked.results, str(revision): about}
    locked.save(update_fields=["results"])
    _measure(locked.id)


def finish(found: Evaluation, state: JobState, error: str = "") -> None:
    """Stores the end of an evaluation, unless somebody has ended or resumed it meanwhile."""
    rows = Evaluation.objects.filter(id=found.id, attempt=found.attempt, state__in=LIVE)
    rows.update(state=state, error=error[:MOST_ERROR], left_s=None, ended_at=timezone.now())


def lost(found: Evaluation | Replay, why: str) -> None:
    """Notes that an executor was lost at it; after three times it has failed."""
    tries = found.tries + 1
    state = JobState.FAILED if tries >= MOST_TRIES else JobState.WAITING
    rows = type(found)._default_manager.filter(id=found.id, state__in=LIVE)
    values: dict[str, Any] = {"state": state, "tries": tries}
    if state == JobState.FAILED:
        values["error"] = why[:MOST_ERROR]
    if isinstance(found, Evaluation):
        values |= {"left_s": None, "ended_at": timezone.now() if state == JobState.FAILED else None}
    rows.update(**values)


def wait_again(found: Evaluation) -> None:
    """Puts a running evaluation back into the queue, since others go first."""
    Evaluation.objects.filter(id=found.id, state=JobState.RUNNING).update(
        state=JobState.WAITING, left_s=None, asked_at=timezone.now()
    )


def replayed(found: Replay, state: JobState, error: str = "", run: Run | None = None) -> None:
    """Stores what became of a replay."""
    rows = Replay.objects.filter(id=found.id)
    rows.update(state=state, error=error[:MOST_ERROR], run=run)


def _require_possible(project: Project) -> None:
    obstacle = why_not(project)
    if obstacle != Obstacle.NONE:
        refusal, hint = _REFUSALS[obstacle]
        raise refusal(str(obstacle.label), hint=hint)


def hours_left(user: User) -> bool:
    """Returns whether a user has processor hours left today."""
    limit = environment().evaluation_hours_a_day
    return not limit or queries.used_hours(user) < limit
