"""The OpenAPI document."""

from __future__ import annotations

from backend.config.schema_view import OpenApi, document


def test_the_document_is_served_as_it_is_made(api):
    assert api.get("openapi.json")["paths"].keys() == document()["paths"].keys()
    assert api.get("/api/v1/docs").startswith(b"<")
    assert OpenApi.__doc__
