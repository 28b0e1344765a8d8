"""The committed schema of evaluations."""

import json

from executor.evaluation.reference.schema import FILE, schema_text


def test_the_schema_is_up_to_date():
    assert FILE.read_text(encoding="utf-8") == schema_text(), (
        "run: python -m executor.evaluation.reference.schema"
    )


def test_the_schema_takes_the_short_forms():
    parts = json.loads(schema_text())["$defs"]
    assert parts["Draw"]["anyOf"][0]["minItems"] == 2
    assert parts["Never"]["anyOf"][0] == {"const": "collision"}
