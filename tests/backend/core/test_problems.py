"""Errors as problem documents."""

from __future__ import annotations

from backend.core.problems import MEDIA_TYPE, NotFoundError, StudioError
from backend.core.rest.openapi import ProblemSerializer


def test_an_error_has_a_code_a_sentence_and_what_to_do(api):
    document = api.get("projects/3f2504e0-4f89-41d3-9a0c-000000000001", expect=404)
    assert api.response.headers["Content-Type"].startswith(MEDIA_TYPE)
    assert document["code"] == NotFoundError.code
    assert set(document) >= {name for name, field in ProblemSerializer().fields.items() if field.required}


def test_every_error_has_a_status_and_a_code_of_its_own() -> None:
    found, waiting = [], [StudioError]
    while waiting:
        error = waiting.pop()
        waiting += error.__subclasses__()
        found.append(error)
    assert all(400 <= error.status < 600 and error.title and error.code for error in found)
