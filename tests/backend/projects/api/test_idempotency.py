"""A request that is repeated has one effect."""

from __future__ import annotations

import io
from types import SimpleNamespace
from typing import Any

import pytest
from rest_framework.response import Response

from backend.ingress.bodies import BODY
from backend.projects.api.idempotency import once, replayed
from backend.projects.errors import IdempotencyError
from backend.projects.models import Project


def test_the_same_key_gives_the_first_answer_and_another_request_is_refused(api):
    headers = {"Idempotency-Key": "make-1"}
    first = api.post("projects", {"name": "One"}, expect=201, **headers)
    assert api.post("projects", {"name": "One"}, expect=201, **headers)["id"] == first["id"]
    assert Project.objects.count() == 1
    assert api.post("projects", {"name": "Two"}, expect=422, **headers)["code"] == "idempotency_key_reused"


def test_a_streamed_body_counts_from_its_beginning_wherever_the_work_has_left_it(user):
    body = io.BytesIO(b"upload")

    def asked():
        about: dict[str, Any] = {
            "method": "POST",
            "content_type": "application/octet-stream",
            "scope": {BODY: body},
        }
        request: Any = SimpleNamespace(headers={"Idempotency-Key": "k"}, get_full_path=lambda: "/x", **about)
        return request

    def effect():
        return Response({"n": 1})

    assert replayed(asked(), user) is None
    body.read(3)
    once(asked(), user, effect)
    body.read(2)
    found = replayed(asked(), user)
    assert found is not None
    assert found.headers["Idempotency-Replayed"] == "true"
    body.seek(0)
    body.write(b"other!")
    with pytest.raises(IdempotencyError):
        replayed(asked(), user)
