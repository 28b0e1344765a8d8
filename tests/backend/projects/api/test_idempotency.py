"""A request that is repeated has one effect."""

from __future__ import annotations

from backend.projects.api import idempotency
from backend.projects.models import Project


def test_the_same_key_gives_the_first_answer_and_another_request_is_refused(api):
    headers = {"Idempotency-Key": "make-1"}
    first = api.post("projects", {"name": "One"}, expect=201, **headers)
    assert api.post("projects", {"name": "One"}, expect=201, **headers)["id"] == first["id"]
    assert Project.objects.count() == 1
    assert api.post("projects", {"name": "Two"}, expect=422, **headers)["code"] == "idempotency_key_reused"
    assert idempotency.once.__doc__
