"""Serializers that are reused accept and refuse the same requests as new ones."""

from __future__ import annotations

import pytest
from rest_framework.exceptions import ValidationError

from backend.accounts.api.requests import parsed
from backend.projects.api.serializers import ChangesSerializer

FILE = {"path": "a.txt", "base_revision": 0, "content": "x"}


def read(body):
    """Returns what a new serializer reads from a body."""
    serializer = ChangesSerializer(data=body)
    serializer.is_valid(raise_exception=True)
    return dict(serializer.validated_data)


@pytest.mark.parametrize(
    "body",
    [{"files": [FILE]}, {"message": "m", "files": [FILE, {"path": "b", "base_revision": 1, "delete": True}]}],
)
def test_what_is_right_is_read(body):
    for _ in range(2):
        assert parsed(ChangesSerializer, body) == read(body)


@pytest.mark.parametrize(
    "body",
    [
        None,
        [],
        "text",
        {},
        {"files": []},
        {"files": None},
        {"files": [FILE], "mesage": "m"},
        {"files": [FILE | {"base_revision": "1"}]},
        {"files": [FILE, FILE | {"base_revision": -1}]},
        {"files": [FILE | {"content_base64": "eA=="}]},
        {"files": [{"path": "a", "base_revision": 0, "content_base64": "!"}]},
    ],
)
def test_what_is_wrong_is_refused_in_the_same_words(body):
    with pytest.raises(ValidationError) as expected:
        read(body)
    with pytest.raises(ValidationError) as found:
        parsed(ChangesSerializer, body)
    assert found.value.detail == expected.value.detail
    assert parsed(ChangesSerializer, {"files": [FILE]}) == read({"files": [FILE]})
