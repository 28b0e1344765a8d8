"""Parts of the document that every operation has in common."""

from __future__ import annotations

from backend.config.schema_view import document
from backend.core.problems import MEDIA_TYPE
from backend.core.rest.openapi import ProblemSerializer, problem_of


def test_every_operation_may_answer_with_a_problem() -> None:
    for operations in document()["paths"].values():
        for operation in operations.values():
            assert MEDIA_TYPE in operation["responses"]["default"]["content"], operation["operationId"]


def test_a_problem_may_have_members_of_its_own() -> None:
    [(status, media_type)] = problem_of(ProblemSerializer, "A conflict.")
    assert (status, media_type) == (409, MEDIA_TYPE)
