"""Recorded examples in the OpenAPI document."""

from __future__ import annotations

from typing import Any

from backend.config.examples import PARAMETERS, illustrate, recorded


def test_parameters_and_answers_get_their_example() -> None:
    operation = next(name for name, example in recorded().items() if "200" in example.get("answers", {}))
    content: dict[str, object] = {"application/json": {}}
    document: Any = {
        "paths": {
            "/x": {
                "get": {
                    "operationId": operation,
                    "parameters": [{"name": "number"}, {"name": "other"}],
                    "responses": {"200": {"content": content}, "default": {"content": {}}},
                }
            }
        }
    }
    illustrate(document)
    assert content["application/json"] == {
        "examples": {"usual": {"value": recorded()[operation]["answers"]["200"]}}
    }
    first, second = document["paths"]["/x"]["get"]["parameters"]
    assert (first["example"], "example" in second) == (PARAMETERS["number"], False)
