"""Requests and answers of imports into a project."""

from __future__ import annotations

import re
from typing import Any, Final

from rest_framework import serializers

from backend.core.rest.openapi import ProblemSerializer

NAME: Final = re.compile(r"[A-Za-z0-9_-]{1,60}")
_ARGUMENT: Final = re.compile(r"([A-Za-z_][A-Za-z0-9_]*):=(.*)", re.DOTALL)
KINDS: Final = ("robot", "universe")


class InspectQuerySerializer(serializers.Serializer[Any]):
    """The query about an upload."""

    filename = serializers.CharField(max_length=400, help_text="The file's name.")


class ImportQuerySerializer(InspectQuerySerializer):
    """The part of an upload that is imported, and how."""

    kind = serializers.ChoiceField(choices=KINDS)
    main = serializers.CharField(
        required=False,
        default="",
        allow_blank=True,
        max_length=1_000,
        help_text="Its file; not needed if only one can be meant.",
    )
    name = serializers.CharField(
        required=False, default="", allow_blank=True, max_length=60, help_text="Its name in the project."
    )
    arg = serializers.ListField(
        child=serializers.CharField(max_length=2_000),
        required=False,
        default=list,
        max_length=100,
        help_text="An argument of macros, `name:=value`; may be repeated.",
    )
    use = serializers.BooleanField(
        required=False, default=False, help_text="The project runs with it from now on."
    )
    simplify = serializers.BooleanField(
        required=False, default=False, help_text="Make meshes of too many triangles smaller."
    )
    replace = serializers.BooleanField(
        required=False, default=False, help_text="Replace the robot or universe of this name."
    )

    def validate_arg(self, value: list[str]) -> list[str]:
        """Refuses what is no argument."""
        if any(_ARGUMENT.fullmatch(text) is None for text in value):
            raise serializers.ValidationError("An argument is name:=value.")
        return value

    def validate_name(self, value: str) -> str:
        """Refuses what is no name of a folder."""
        if value and NAME.fullmatch(value) is None:
            raise serializers.ValidationError("A name has letters, digits, _ and -, and 60 at most.")
        return value


class ArgumentSerializer(serializers.Serializer[Any]):
    """An argument of macros; one without a default must be given."""

    name = serializers.CharField()
    default = serializers.CharField(allow_null=True)


class ImportItemSerializer(serializers.Serializer[Any]):
    """A robot, a world or a map in an upload."""

    kind = serializers.ChoiceField(choices=KINDS)
    source = serializers.ChoiceField(choices=["urdf", "xacro", "sdf", "map"])  # type: ignore[assignment]
    path = serializers.CharField(help_text="Its file, for `main`.")
    name = serializers.CharField(help_text="A name for it that is free in the project.")
    is_main = serializers.BooleanField(help_text="No other file of the upload includes it.")
    arguments = ArgumentSerializer(many=True)


class ReportLineSerializer(serializers.Serializer[Any]):
    """A line of a report, with its place in the upload if it has one."""

    file = serializers.CharField(allow_blank=True)
    line = serializers.IntegerField(allow_null=True)
    text = serializers.CharField()


class InspectedSerializer(serializers.Serializer[Any]):
    """The content of an upload; the most likely items first."""

    items = ImportItemSerializer(many=True)
    left_out = ReportLineSerializer(many=True)


class ImportReportSerializer(serializers.Serializer[Any]):
    """The lines about parts that an import took, assumed and left out."""

    taken = ReportLineSerializer(many=True)
    assumed = ReportLineSerializer(many=True)
    left_out = ReportLineSerializer(many=True)


class TestDriveSerializer(serializers.Serializer[Any]):
    """The motion of an imported robot at a command of 1 m and of 360°."""

    way_m = serializers.FloatField()
    aside_m = serializers.FloatField(help_text="The way to the side.")
    turn_deg = serializers.FloatField()
    fits = serializers.BooleanField(help_text="It moved as commanded, within 5 cm and 10°.")


class ImportedPartSerializer(serializers.Serializer[Any]):
    """An imported robot or universe, which is one revision of the project."""

    revision = serializers.IntegerField()
    previous_revision = serializers.IntegerField()
    name = serializers.CharField()
    path = serializers.CharField(help_text="Its robot.yaml, or the universe.")
    paths = serializers.ListField(child=serializers.CharField(), help_text="All files that were written.")
    removed = serializers.ListField(child=serializers.CharField(), help_text="Files that it replaced.")
    report = ImportReportSerializer()
    test_drive = TestDriveSerializer(allow_null=True)
    can_simplify = serializers.BooleanField(help_text="`simplify` would bring meshes that were left out.")
    things = serializers.IntegerField(allow_null=True, help_text="Things and people of a universe.")


class RefusalSerializer(serializers.Serializer[Any]):
    """A reason why it cannot be imported."""

    file = serializers.CharField()
    line = serializers.IntegerField()
    message = serializers.CharField()
    hint = serializers.CharField(allow_blank=True)


class ImportProblemSerializer(ProblemSerializer):
    """Why nothing was imported."""

    diagnostics = RefusalSerializer(many=True, required=False)
    items = ImportItemSerializer(many=True, required=False)
