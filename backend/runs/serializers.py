"""Stored runs in the API."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rest_framework import serializers

from backend.core.rest.fields import StrictSerializer
from backend.projects.choices import Role
from backend.runs.choices import Result
from backend.runs.models import MAX_NAME_LENGTH, MAX_NOTE_LENGTH
from backend.runs.queries import may_manage, may_share

if TYPE_CHECKING:
    from backend.accounts.models import User
    from backend.runs.models import Run


class RunSerializer(serializers.Serializer[Any]):
    """A stored run."""

    id = serializers.UUIDField()
    name = serializers.CharField()
    note = serializers.CharField()
    result = serializers.ChoiceField(choices=Result.choices)
    start_s = serializers.FloatField(help_text="Simulated time of the first message in s.")
    length_s = serializers.FloatField(help_text="Simulated time in s, from the first message to the last.")
    size = serializers.IntegerField(help_text="In bytes.")
    is_pinned = serializers.BooleanField()
    is_shared = serializers.BooleanField(help_text="Whether all who may read the project see it.")
    is_last = serializers.BooleanField(
        help_text="Whether it was kept by itself; the next last run replaces it."
    )
    has_thumbnail = serializers.BooleanField(help_text="Whether there is a small picture of it.")
    may_manage = serializers.BooleanField(help_text="Whether you may rename, pin and delete it.")
    may_share = serializers.BooleanField(help_text="Whether you may share it with the project.")
    keeper = serializers.CharField(help_text="The user who kept it.")
    recorded_as = serializers.CharField(help_text="The name that its session gave it.")
    created_at = serializers.DateTimeField()


class MyRunSerializer(RunSerializer):
    """A run that you have kept, and its project."""

    project = serializers.UUIDField()
    project_name = serializers.CharField(help_text="Empty if you may no longer read the project.")
    may_open = serializers.BooleanField(help_text="Whether you may still read its project.")


class MyRunListSerializer(serializers.Serializer[Any]):
    """The runs that you have kept."""

    items = MyRunSerializer(many=True)


class RunListSerializer(serializers.Serializer[Any]):
    """The stored runs of a project."""

    items = RunSerializer(many=True)


class KeepRunSerializer(StrictSerializer):
    """A run of your session that is to be stored."""

    run = serializers.RegexField(r"^[0-9a-f]{1,32}$", help_text="Its name in the event `segment`.")
    name = serializers.CharField(max_length=MAX_NAME_LENGTH)
    note = serializers.CharField(max_length=MAX_NOTE_LENGTH, allow_blank=True, default="")
    session = serializers.UUIDField(
        required=False, help_text="Your attached session; by default your session of this project."
    )


class ChangeRunSerializer(StrictSerializer):
    """New values of a stored run; fields that are missing stay unchanged."""

    name = serializers.CharField(max_length=MAX_NAME_LENGTH, required=False)
    note = serializers.CharField(max_length=MAX_NOTE_LENGTH, allow_blank=True, required=False)
    is_pinned = serializers.BooleanField(required=False)
    is_shared = serializers.BooleanField(required=False)
    is_last = serializers.ChoiceField(
        choices=[False], required=False, help_text="`false` keeps the last run, as any change of it does."
    )


def presented(run: Run, user: User) -> dict[str, Any]:
    """Returns a run as JSON for a user."""
    plain = ("name", "note", "result", "start_s", "length_s", "size", "is_pinned", "is_shared", "is_last")
    return {name: getattr(run, name) for name in (*plain, "recorded_as")} | {
        "has_thumbnail": bool(run.thumbnail_type),
        "id": str(run.id),
        "may_manage": may_manage(run, user=user),
        "may_share": may_share(run, user=user),
        "keeper": run.keeper.username,
        "created_at": run.created_at.isoformat(),
    }


def presented_mine(run: Run, user: User) -> dict[str, Any]:
    """Returns a run as JSON for its keeper, with its project; one that they may not read has no name."""
    may_open = run.project.role != Role.NONE
    return presented(run, user) | {
        "project": str(run.project_id),
        "project_name": run.project.name if may_open else "",
        "may_open": may_open,
    }
