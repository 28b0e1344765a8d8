"""Writes the JSON Schema of `robot.yaml`: `python -m executor.robots.reference`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

from executor.robots.config import RobotDocument

_ROOT: Final = Path(__file__).parents[2]
PAGE: Final = _ROOT / "docs" / "reference" / "schemas" / "robot.schema.json"
# The editor validates robots with this schema. It is kept in the front end, which then builds without Python.
FOR_THE_EDITOR: Final = _ROOT / "frontend" / "src" / "generated" / "robot.schema.json"


def schema() -> str:
    """Returns the schema's text."""
    document = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **RobotDocument.model_json_schema(),
    }
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def main() -> None:
    """Writes the schema, for the docs and for the editor."""
    for path in (PAGE, FOR_THE_EDITOR):
        path.write_text(schema(), encoding="utf-8")


if __name__ == "__main__":
    main()
