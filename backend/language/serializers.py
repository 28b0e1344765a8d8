"""Requests and answers of the Python API."""

from __future__ import annotations

from rest_framework import serializers


class SourceSerializer(serializers.Serializer[dict[str, str]]):
    """A source with the name of its file."""

    source = serializers.CharField(allow_blank=True, trim_whitespace=False, max_length=1_048_576)  # type: ignore[assignment]
    filename = serializers.CharField(max_length=400, default="action.py")


class PlaceSerializer(serializers.Serializer[dict[str, int]]):
    """A place in a text: line and column count from 1, columns in code points."""

    line = serializers.IntegerField()
    column = serializers.IntegerField()


class EditSerializer(serializers.Serializer[dict[str, object]]):
    """A range of a text, and its replacement."""

    start = PlaceSerializer()
    end = PlaceSerializer()
    content = serializers.CharField(allow_blank=True)


class FixSerializer(serializers.Serializer[dict[str, object]]):
    """The fix of a finding."""

    message = serializers.CharField()
    edits = EditSerializer(many=True)


class FindingSerializer(serializers.Serializer[dict[str, object]]):
    """One finding of the linter."""

    code = serializers.CharField()
    severity = serializers.ChoiceField(choices=["error", "warning"])
    message = serializers.CharField()
    start = PlaceSerializer()
    end = PlaceSerializer()
    fix = FixSerializer(allow_null=True)


class FindingsSerializer(serializers.Serializer[dict[str, object]]):
    """All findings about a source."""

    findings = FindingSerializer(many=True)


class FormattedSerializer(serializers.Serializer[dict[str, object]]):
    """A formatted source; one that does not parse is unchanged, with its errors."""

    source = serializers.CharField()  # type: ignore[assignment]
    findings = FindingSerializer(many=True)


class TestTurnSerializer(serializers.Serializer[dict[str, object]]):
    """The turn of tests with Python that wait for a place."""

    position = serializers.IntegerField(
        allow_null=True, help_text="Place in the queue, from 1, while tests wait; null if none wait."
    )
    waits_for_own = serializers.BooleanField(
        help_text="Whether they wait until other tests of their user end, not until the server has room."
    )
