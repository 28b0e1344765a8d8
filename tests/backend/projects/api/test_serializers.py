"""Contents of requests."""

from __future__ import annotations

from typing import Any

import pytest

from backend.projects.api.serializers import ChangesSerializer, CreateProjectSerializer, file_changes

ONE = {"path": "a.txt", "base_revision": 0, "content": "x"}


def test_a_change_is_read():
    serializer = ChangesSerializer(data={"files": [ONE]})
    assert serializer.is_valid(), serializer.errors
    [change] = file_changes(serializer.validated_data)
    assert (change.path, change.base_revision) == ("a.txt", 0)


@pytest.mark.parametrize(
    "wrong", [{"base_revision": "0"}, {"base_revision": True}, {"content": 5}, {"unknown": 1}, {"path": None}]
)
def test_types_are_not_guessed(wrong: dict[str, Any]):
    assert not ChangesSerializer(data={"files": [ONE | wrong]}).is_valid()


def test_an_unknown_field_is_refused():
    assert not CreateProjectSerializer(data={"name": "x", "colour": "red"}).is_valid()
