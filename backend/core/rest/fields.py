"""Fields and a base class of serializers that take nothing for something else."""

from __future__ import annotations

from typing import Any, Final

from drf_spectacular.utils import extend_schema_field
from rest_framework import serializers

OBJECT: Final = {"type": "object", "additionalProperties": {}}


@extend_schema_field(OBJECT)
class ObjectField(serializers.JSONField):
    """A JSON object."""

    def to_internal_value(self, data: Any) -> Any:
        """Refuses every other JSON value."""
        value = super().to_internal_value(data)
        if not isinstance(value, dict):
            raise serializers.ValidationError("This must be a JSON object.")
        return value


class TextField(serializers.CharField):
    """Text that is kept unchanged: it is not trimmed. Numbers and booleans are refused."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"trim_whitespace": False, "allow_blank": True, **kwargs})

    def to_internal_value(self, data: Any) -> str:
        """Returns the text; refuses any other value."""
        if not isinstance(data, str):
            raise serializers.ValidationError("This must be text.")
        return super().to_internal_value(data)


class StrictIntegerField(serializers.IntegerField):
    """An integer; text that looks like a number is refused."""

    def to_internal_value(self, data: Any) -> int:
        """Returns the integer; refuses text and booleans."""
        if isinstance(data, bool) or not isinstance(data, int):
            raise serializers.ValidationError("This must be a whole number.")
        return super().to_internal_value(data)


class StrictBooleanField(serializers.BooleanField):
    """True or false; words for these values are refused."""

    def to_internal_value(self, data: Any) -> bool:
        """Returns the boolean; refuses any other value."""
        if not isinstance(data, bool):
            raise serializers.ValidationError("This must be true or false.")
        return data


class StrictSerializer(serializers.Serializer[Any]):
    """Refuses unknown fields, so that a misspelt field is never ignored."""

    def to_internal_value(self, data: Any) -> Any:
        """Returns the checked values; an error names each unknown field."""
        if isinstance(data, dict) and (unknown := set(data) - set(self.fields)):
            raise serializers.ValidationError({str(min(unknown))[:100]: "There is no such field."})
        return super().to_internal_value(data)
