"""Views of evaluations."""

from __future__ import annotations

from functools import partial
from typing import IO, TYPE_CHECKING

from django.db import transaction
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.file_answers import FileAnswer, saved_as
from backend.core.problems import NotFoundError
from backend.core.scratch import scratch
from backend.evaluations import queries, results, work, writes
from backend.evaluations import serializers as s
from backend.evaluations.rounds import round_soon
from backend.projects.api.schema import NOT_SOUND
from backend.projects.api.serializers_tests import CoverageSerializer
from backend.projects.documents import checking
from backend.projects.storage.queries import fetched, listed_at
from backend.workers.aside import conversions
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from concurrent.futures import Future
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.evaluations.models import Evaluation


class Evaluations(ResourceViewSet):
    """The evaluations of a project.

    What writes also reads for its answer within the transaction: nothing after it can hide that it was done.
    """

    lookup_url_kwarg = "evaluation_id"
    lookup_value_converter = "uuid"
    expensive = ("POST",)

    @extend_schema(
        operation_id="list_evaluations", responses=s.EvaluationListSerializer, tags=["evaluations"]
    )
    def list(self, request: Request, project_id: UUID) -> Response:
        """Lists the evaluations of a project, the newest first; the last 50 are kept."""
        user = user_of(request)
        project, rows = queries.evaluations(project_id, user=user)
        counts, waits = queries.counts(rows), work.waits_for(rows)
        answer = {
            "items": [s.presented(row, counts, waits) for row in rows],
            "costs": queries.costs(rows),
            "may_start": s.may_start(project.role, is_guest=user.is_guest),
            "may_replay": not user.is_guest,
            "why_not": writes.why_not(project).value,
        }
        return Response(answer)

    @extend_schema(
        operation_id="start_evaluation",
        request=s.StartEvaluationSerializer,
        responses={201: s.EvaluationSerializer},
        tags=["evaluations"],
    )
    @transaction.atomic
    def create(self, request: Request, project_id: UUID) -> Response:
        """Puts an evaluation of the current revision into the queue."""
        asked, user = parsed(s.StartEvaluationSerializer, request.data), user_of(request)
        found = writes.start(
            project_id, asked["name"], asked["runs"], acting_user=user, sealed=asked["sealed"]
        )
        return _begun(found, 201)

    @extend_schema(operation_id="get_evaluation", responses=s.EvaluationSerializer, tags=["evaluations"])
    def retrieve(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Returns one evaluation."""
        return _answer(queries.evaluation(project_id, evaluation_id, user=user_of(request)))

    @extend_schema(operation_id="delete_evaluation", responses={204: None}, tags=["evaluations"])
    def destroy(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Deletes an evaluation with its outcomes; one that runs ends."""
        writes.delete(project_id, evaluation_id, acting_user=user_of(request))
        return Response(status=204)

    @extend_schema(
        operation_id="cancel_evaluation",
        request=None,
        responses=s.EvaluationSerializer,
        tags=["evaluations"],
    )
    @action(detail=True, methods=["post"], expensive=())
    @transaction.atomic
    def cancel(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Ends an evaluation; what is done is kept, and it can be resumed."""
        return _answer(writes.cancel(project_id, evaluation_id, acting_user=user_of(request)))

    @extend_schema(
        operation_id="resume_evaluation",
        request=None,
        responses=s.EvaluationSerializer,
        tags=["evaluations"],
    )
    @action(detail=True, methods=["post"], expensive=("POST",))
    @transaction.atomic
    def resume(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Runs what an evaluation lacks. Runs that said nothing of the project are run again."""
        return _begun(writes.resume(project_id, evaluation_id, acting_user=user_of(request)))

    @extend_schema(
        operation_id="compare_evaluation",
        request=s.CompareSerializer,
        responses=s.EvaluationSerializer,
        tags=["evaluations"],
    )
    @action(detail=True, methods=["post"], expensive=("POST",))
    @transaction.atomic
    def compare(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Runs the same seeds with an older revision, in the same worlds."""
        asked, user = parsed(s.CompareSerializer, request.data), user_of(request)
        return _begun(writes.compare(project_id, evaluation_id, asked["revision"], acting_user=user))

    @extend_schema(operation_id="get_comparison", responses=s.ComparisonSerializer, tags=["evaluations"])
    @action(detail=True)
    def comparison(self, request: Request, project_id: UUID, evaluation_id: UUID) -> HttpResponseBase:
        """Returns what differs between the two revisions on the seeds that both have run."""
        user = user_of(request)
        found = queries.evaluation(project_id, evaluation_id, user=user)
        work = conversions.ask(f"user {user.pk}", partial(results.comparison_of, found))

        def compared(done: Future[results.Comparison]) -> Response:
            return Response(s.presented_comparison(done.result()))

        return Deferred(self, request, work, compared)

    @extend_schema(
        operation_id="get_evaluation_coverage",
        parameters=[s.RevisionQuerySerializer],
        responses={200: CoverageSerializer} | NOT_SOUND,
        tags=["evaluations"],
    )
    @action(detail=True)
    def coverage(self, request: Request, project_id: UUID, evaluation_id: UUID) -> HttpResponseBase:
        """Returns which blocks the runs of a revision ticked, and which results these had, in any run."""
        found = queries.evaluation(project_id, evaluation_id, user=user_of(request))
        revision = _revision(request, found)
        listed = [
            file
            for path, file in listed_at(found.project, revision).items()
            if path.startswith(checking.CHECKED)
        ]
        checking.require_checkable(file.size for file in listed)
        files = {path: file.data for path, file in fetched(listed).items()}
        return checking.covered(self, request, files, queries.seen(found, revision), Response)

    @extend_schema(
        operation_id="list_outcomes",
        parameters=[s.OutcomeListQuerySerializer],
        responses=s.OutcomeListSerializer,
        tags=["evaluations"],
    )
    @action(detail=True)
    def outcomes(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Lists the outcomes that came after a cursor, in the order in which they came; at most 2,000."""
        asked = parsed(s.OutcomeListQuerySerializer, request.query_params.dict())
        found = queries.evaluation(project_id, evaluation_id, user=user_of(request))
        rows = queries.outcomes(found, _revision_of(found, asked.get("revision")), asked["after"])
        cursor = rows[-1].pk if rows else asked["after"]
        return Response({"items": [s.presented_outcome(row) for row in rows], "cursor": cursor})

    @extend_schema(
        operation_id="get_outcome",
        parameters=[s.RevisionQuerySerializer],
        responses=s.WholeOutcomeSerializer,
        tags=["evaluations"],
    )
    @action(detail=True, url_path="outcomes/<int:seed>")
    def outcome(self, request: Request, project_id: UUID, evaluation_id: UUID, seed: int) -> Response:
        """Returns all that is known of one run."""
        found = queries.evaluation(project_id, evaluation_id, user=user_of(request))
        return Response(s.presented_whole(queries.outcome(found, _revision(request, found), seed)))

    @extend_schema(
        operation_id="ask_replay",
        request=s.AskReplaySerializer,
        responses={201: s.ReplaySerializer},
        tags=["evaluations"],
    )
    @action(detail=True, methods=["post"], expensive=("POST",))
    @transaction.atomic
    def replays(self, request: Request, project_id: UUID, evaluation_id: UUID) -> Response:
        """Runs a seed again, records it and keeps it as a stored run of yours."""
        asked, user = parsed(s.AskReplaySerializer, request.data), user_of(request)
        row = writes.ask_replay(project_id, evaluation_id, asked["revision"], asked["seed"], acting_user=user)
        transaction.on_commit(round_soon, robust=True)
        return Response(s.presented_replay(row), status=201)

    @extend_schema(operation_id="get_replay", responses=s.ReplaySerializer, tags=["evaluations"])
    @action(detail=True, url_path="replays/<uuid:replay_id>")
    def replay(self, request: Request, project_id: UUID, evaluation_id: UUID, replay_id: UUID) -> Response:
        """Returns what became of a replay."""
        user = user_of(request)
        found = queries.evaluation(project_id, evaluation_id, user=user)
        return Response(s.presented_replay(queries.replay(found, replay_id, user=user)))

    @extend_schema(operation_id="cancel_replay", request=None, responses={204: None}, tags=["evaluations"])
    @replay.mapping.delete
    def cancel_replay(
        self, request: Request, project_id: UUID, evaluation_id: UUID, replay_id: UUID
    ) -> Response:
        """Takes the wish for a replay back; one that runs ends."""
        writes.cancel_replay(project_id, evaluation_id, replay_id, acting_user=user_of(request))
        return Response(status=204)

    @extend_schema(
        operation_id="download_outcomes",
        parameters=[s.RevisionQuerySerializer],
        responses={(200, "application/x-ndjson"): OpenApiTypes.BINARY},
        tags=["evaluations"],
    )
    @action(detail=True, url_path="runs.jsonl")
    def download(self, request: Request, project_id: UUID, evaluation_id: UUID) -> FileAnswer:
        """Returns `runs.jsonl`: a line for each outcome, in the order of the seeds."""
        user = user_of(request)
        found = queries.evaluation(project_id, evaluation_id, user=user)
        who = f"guests of {project_id}" if user.is_guest else user.pk
        file = scratch().file(key=f"outcomes for {who}")
        try:
            for line in queries.lines(found, _revision(request, found)):
                file.write(line.encode() + b"\n")
        except BaseException:
            file.close()
            raise
        return FileAnswer(file, headers=_attached("runs.jsonl", "application/x-ndjson; charset=utf-8"))

    @extend_schema(
        operation_id="download_report",
        responses={(200, "text/html"): OpenApiTypes.BINARY},
        tags=["evaluations"],
    )
    @action(detail=True, url_path="report.html")
    def report(self, request: Request, project_id: UUID, evaluation_id: UUID) -> HttpResponseBase:
        """Returns the report: one page that needs nothing else."""
        user = user_of(request)
        found = queries.evaluation(project_id, evaluation_id, user=user, has_plan=True)
        work = conversions.ask(f"user {user.pk}", partial(results.report_of, found))

        def made(done: Future[IO[bytes]]) -> FileAnswer:
            name = f"{found.name}-{found.revision}.html"
            return FileAnswer(done.result(), headers=_attached(name, "text/html; charset=utf-8"))

        return Deferred(self, request, work, made)


def _attached(name: str, kind: str) -> dict[str, str]:
    return saved_as(name) | {
        "Content-Type": kind,
        "X-Content-Type-Options": "nosniff",
        "Cache-Control": "private, no-cache",
    }


def _answer(found: Evaluation, status: int = 200) -> Response:
    return Response(s.presented(found, queries.counts([found]), work.waits_for([found])), status=status)


def _begun(found: Evaluation, status: int = 200) -> Response:
    transaction.on_commit(round_soon, robust=True)
    return _answer(found, status)


def _revision(request: Request, found: Evaluation) -> int:
    """Returns the revision that a request names."""
    asked = parsed(s.RevisionQuerySerializer, request.query_params.dict())
    return _revision_of(found, asked.get("revision"))


def _revision_of(found: Evaluation, named: int | None) -> int:
    """Returns one of the two revisions of an evaluation: the named one, else its own."""
    if named not in {None, found.revision, found.older}:
        raise NotFoundError(f"The evaluation is not of revision {named}.")
    return found.revision if named is None else named
