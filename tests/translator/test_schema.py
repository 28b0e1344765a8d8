"""The schemas of the files of a project."""

from __future__ import annotations

import jsonschema
import pytest

from translator.schema import SCHEMAS, json_schema


@pytest.mark.parametrize("name", SCHEMAS)
def test_a_schema_is_one(name: str) -> None:
    jsonschema.Draft202012Validator.check_schema(json_schema(name))


def test_a_diagram_with_a_node_of_no_type_is_refused() -> None:
    document = {"format": "bt-studio/diagram", "version": 1, "id": "A", "root": "n1", "nodes": {"n1": {}}}
    with pytest.raises(jsonschema.ValidationError, match="type"):
        jsonschema.validate(document, json_schema("diagram"))
