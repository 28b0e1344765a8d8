"""Writes the JSON Schema of the evaluation format: `python -m executor.evaluation.reference.schema`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Final

from executor.evaluation.document import Evaluation

FILE: Final = Path(__file__).parents[3] / "docs" / "reference" / "schemas" / "evaluation.schema.json"


def schema_text() -> str:
    """Returns the schema, with the short forms that the reader also takes."""
    document: dict[str, Any] = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **Evaluation.model_json_schema(),
    }
    parts = document["$defs"]
    number = {"type": "number"}
    short = {"type": "array", "prefixItems": [number, number], "minItems": 2, "maxItems": 2}
    parts["Draw"] = {"anyOf": [{**short, "description": "Uniform from a to b."}, parts["Draw"]]}
    parts["Never"] = {"anyOf": [{"const": "collision"}, parts["Never"]]}
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def main() -> None:
    """Writes the schema."""
    FILE.parent.mkdir(parents=True, exist_ok=True)
    FILE.write_text(schema_text(), encoding="utf-8")


if __name__ == "__main__":
    main()
