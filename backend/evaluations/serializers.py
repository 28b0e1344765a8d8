"""Evaluations in the API."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from rest_framework import serializers

from backend.core.rest.fields import ObjectField, StrictIntegerField, StrictSerializer
from backend.evaluations.choices import JobState, Obstacle, Result, WaitsFor
from backend.evaluations.models import MAX_NAME_LENGTH
from backend.projects.choices import Role

if TYPE_CHECKING:
    from collections.abc import Mapping
    from uuid import UUID

    from backend.evaluations.models import Evaluation, Outcome, Replay
    from backend.evaluations.results import Comparison

MOST_RUNS = 100_000


class SideSerializer(serializers.Serializer[Any]):
    """The results of one revision."""

    revision = serializers.IntegerField()
    done = serializers.IntegerField(help_text="Runs that have an outcome.")
    wanted = serializers.IntegerField(allow_null=True, help_text="Of so many; null while it is not known.")
    rate = serializers.FloatField(help_text="The share of successes among the outcomes that count.")
    low = serializers.FloatField(help_text="The lower end of its 95 % interval.")
    high = serializers.FloatField(help_text="The upper end.")
    counts = serializers.DictField(child=serializers.IntegerField(), help_text="Runs by outcome.")


class EvaluationSerializer(serializers.Serializer[Any]):
    """An evaluation of a revision of the project."""

    id = serializers.UUIDField()
    name = serializers.CharField(help_text="The evaluation is evaluations/<name>.yaml.")
    revision = serializers.IntegerField()
    older = serializers.IntegerField(allow_null=True, help_text="The revision with which it is compared.")
    seed = serializers.IntegerField(allow_null=True, help_text="The first seed, once it is known.")
    sequential = serializers.BooleanField(help_text="Whether the outcomes decide the number of runs.")
    sealed = serializers.BooleanField(
        help_text="Whether tree and actions ran in a process that sees nothing of the judge."
    )
    duration_s = serializers.FloatField(help_text="The longest time of a run, in simulated s.")
    workers = serializers.IntegerField(help_text="Runs at a time.")
    state = serializers.ChoiceField(choices=JobState.choices)
    waits_for = serializers.ChoiceField(
        choices=WaitsFor.choices,
        help_text="While it waits: processor hours of its user, users who work, or its turn. Else empty.",
    )
    error = serializers.CharField(help_text="Why it failed, a line for each problem; else empty.")
    notes = serializers.CharField(
        help_text="A line for each part of the project that does not run, such as a launch node; else empty."
    )
    attempt = serializers.IntegerField(help_text="Changes when it is begun again; outcomes may have gone.")
    left_s = serializers.FloatField(allow_null=True, help_text="The time that is probably left, in s.")
    author = serializers.CharField(help_text="The user who started it last.")
    created_at = serializers.DateTimeField()
    ended_at = serializers.DateTimeField(allow_null=True)
    sides = SideSerializer(many=True, help_text="The revision, and then the older one, if there is one.")


class CostSerializer(serializers.Serializer[Any]):
    """The cost of a run of an evaluation so far."""

    name = serializers.CharField(help_text="Of the evaluation.")
    cpu_s = serializers.FloatField(help_text="The mean processor time of a run, in s.")
    workers = serializers.IntegerField(help_text="Runs at a time.")


class EvaluationListSerializer(serializers.Serializer[Any]):
    """The evaluations of a project, the newest first."""

    items = EvaluationSerializer(many=True)
    costs = CostSerializer(many=True, help_text="By the last evaluation of each name that has outcomes.")
    may_start = serializers.BooleanField(help_text="Whether you may start evaluations of this project.")
    may_replay = serializers.BooleanField(help_text="Whether you may play a run again.")
    why_not = serializers.ChoiceField(
        choices=[(each.value, each.value) for each in Obstacle],
        help_text="Why none can be started: the server has one place for robots, or the project is archived. "
        "Else empty.",
    )


class StartEvaluationSerializer(StrictSerializer):
    """An evaluation that is to be run."""

    name = serializers.CharField(max_length=MAX_NAME_LENGTH)
    runs = StrictIntegerField(
        min_value=0, max_value=MOST_RUNS, default=0, help_text="So many runs; 0 is as the file says."
    )
    sealed = serializers.BooleanField(
        default=False, help_text="Keep tree and actions in a process that sees nothing of the judge."
    )


class CompareSerializer(StrictSerializer):
    """The revision with which an evaluation is to be compared."""

    revision = StrictIntegerField(min_value=1, max_value=2**31 - 1)


class AskReplaySerializer(StrictSerializer):
    """A run that is to be played."""

    revision = StrictIntegerField(min_value=1, max_value=2**31 - 1)
    seed = StrictIntegerField(min_value=0, max_value=2**63 - 1)


class RevisionQuerySerializer(serializers.Serializer[Any]):
    """The query for one of the two revisions."""

    revision = serializers.IntegerField(
        required=False,
        min_value=1,
        max_value=2**31 - 1,
        help_text="Of the two, if it is compared; else its own.",
    )


class OutcomeListQuerySerializer(RevisionQuerySerializer):
    """The query of a part of the outcomes."""

    after = serializers.IntegerField(
        required=False,
        default=0,
        min_value=0,
        max_value=2**63 - 1,
        help_text="The `cursor` of the answer before.",
    )


class OutcomeSerializer(serializers.Serializer[Any]):
    """The outcome of one run."""

    seed = serializers.IntegerField()
    outcome = serializers.ChoiceField(choices=Result.choices)
    why = serializers.CharField()
    end_s = serializers.FloatField(help_text="The simulated time at which it was decided, in s.")
    margin = serializers.FloatField(
        allow_null=True, help_text="By how much the nearest item held; negative if it failed."
    )
    unit = serializers.CharField(help_text="The unit of the margin.")
    measures = serializers.DictField(child=serializers.FloatField())


class OutcomeListSerializer(serializers.Serializer[Any]):
    """Outcomes in the order in which they came."""

    items = OutcomeSerializer(many=True)
    cursor = serializers.IntegerField(help_text="`after` of the next request.")


class WholeOutcomeSerializer(serializers.Serializer[Any]):
    """All that is known of one run."""

    outcome = ObjectField(help_text="Its line of runs.jsonl.")


class ReplaySerializer(serializers.Serializer[Any]):
    """A run that is run again and recorded."""

    id = serializers.UUIDField()
    seed = serializers.IntegerField()
    revision = serializers.IntegerField()
    state = serializers.ChoiceField(choices=JobState.choices)
    error = serializers.CharField()
    run = serializers.UUIDField(allow_null=True, help_text="The stored run, once it is there.")


class MeasureDifferenceSerializer(serializers.Serializer[Any]):
    """The difference of a measure."""

    name = serializers.CharField()
    pairs = serializers.IntegerField()
    difference = serializers.ListField(child=serializers.FloatField(), help_text="Mean, low and high.")


class ComparisonSerializer(serializers.Serializer[Any]):
    """Two revisions on the same seeds."""

    difference = serializers.ListField(
        child=serializers.FloatField(),
        help_text="Of the rates, newer minus older, and Newcombe's paired 95 % interval.",
    )
    p = serializers.FloatField(help_text="McNemar's exact test, two-sided.")
    both = serializers.IntegerField(help_text="Seeds on which both succeed.")
    neither = serializers.IntegerField()
    only_older = serializers.ListField(child=serializers.IntegerField(), help_text="Seeds.")
    only_newer = serializers.ListField(child=serializers.IntegerField(), help_text="Seeds.")
    measures = MeasureDifferenceSerializer(many=True)


def presented(
    found: Evaluation,
    counts: Mapping[tuple[UUID, int], dict[str, int]],
    waits: Mapping[UUID, WaitsFor],
) -> dict[str, Any]:
    """Returns an evaluation as JSON."""
    plain = ("name", "revision", "older", "seed", "sealed", "sequential", "duration_s", "workers", "state")
    revisions = [found.revision, *([] if found.older is None else [found.older])]
    return {name: getattr(found, name) for name in (*plain, "error", "notes", "attempt", "left_s")} | {
        "id": str(found.id),
        "waits_for": waits.get(found.id, WaitsFor.NOTHING).value,
        "author": found.user.username,
        "created_at": found.created_at.isoformat(),
        "ended_at": None if found.ended_at is None else found.ended_at.isoformat(),
        "sides": [_side(found, revision, counts) for revision in revisions],
    }


def _side(
    found: Evaluation, revision: int, counts: Mapping[tuple[UUID, int], dict[str, int]]
) -> dict[str, Any]:
    about = found.results.get(str(revision), {})
    by_outcome = counts.get((found.id, revision), {})
    wanted = about.get("wanted", found.wanted if revision == found.revision else None)
    shares = {name: about.get(name, 0.0) for name in ("rate", "low", "high")}
    return {"revision": revision, "done": sum(by_outcome.values()), "wanted": wanted, **shares} | {
        "counts": by_outcome
    }


def may_start(role: Role, *, is_guest: bool) -> bool:
    """Returns whether somebody may start evaluations: who may change the project."""
    return role >= Role.EDITOR and not is_guest


def presented_outcome(row: Outcome) -> dict[str, Any]:
    """Returns an outcome as JSON."""
    names = ("seed", "outcome", "why", "end_s", "margin", "unit", "measures")
    return {name: getattr(row, name) for name in names}


def presented_whole(row: Outcome) -> dict[str, Any]:
    """Returns all that is known of a run."""
    return {"outcome": json.loads(row.line)}


def presented_replay(row: Replay) -> dict[str, Any]:
    """Returns a replay as JSON."""
    plain = {name: getattr(row, name) for name in ("seed", "revision", "state", "error")}
    return {"id": str(row.id), "run": None if row.run_id is None else str(row.run_id), **plain}


def presented_comparison(found: Comparison) -> dict[str, Any]:
    """Returns a comparison as JSON."""
    names = ("p", "both", "neither", "only_older", "only_newer")
    return {name: getattr(found, name) for name in names} | {
        "difference": list(found.difference),
        "measures": [
            {"name": each.name, "pairs": each.pairs, "difference": list(each.difference)}
            for each in found.measures
        ],
    }
