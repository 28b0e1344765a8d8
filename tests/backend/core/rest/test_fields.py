"""Fields that take nothing for something else."""

from __future__ import annotations

import pytest
from rest_framework import serializers

from backend.core.rest.fields import (
    ObjectField,
    StrictBooleanField,
    StrictIntegerField,
    StrictSerializer,
    TextField,
)


class Asked(StrictSerializer):
    """One field of each kind."""

    settings = ObjectField(required=False)
    text = TextField(required=False)
    number = StrictIntegerField(required=False)
    yes = StrictBooleanField(required=False)


def errors(**data):
    asked = Asked(data=data)
    return {} if asked.is_valid() else {name: str(found[0]) for name, found in asked.errors.items()}


def test_values_of_the_right_kind_are_taken_unchanged():
    data = {"settings": {"a": 1}, "text": " two\n", "number": 3, "yes": False}
    asked = Asked(data=data)
    assert asked.is_valid()
    assert dict(asked.validated_data) == data


@pytest.mark.parametrize(
    ("data", "text"),
    [
        ({"settings": [1]}, "This must be a JSON object."),
        ({"text": 5}, "This must be text."),
        ({"number": "3"}, "This must be a whole number."),
        ({"number": True}, "This must be a whole number."),
        ({"yes": "true"}, "This must be true or false."),
        ({"yes": 1}, "This must be true or false."),
    ],
)
def test_values_of_another_kind_are_refused(data, text):
    assert errors(**data) == {next(iter(data)): text}


def test_a_misspelt_field_is_refused_by_its_name():
    asked = Asked(data={"nummer": 3})
    assert not asked.is_valid()
    assert asked.errors == {"nummer": "There is no such field."}


def test_the_fields_are_those_of_drf():
    assert issubclass(TextField, serializers.CharField)
