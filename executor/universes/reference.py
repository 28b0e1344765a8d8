"""Writes the JSON Schemas of the universe format: `python -m executor.universes.reference`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

from executor.universes.model import Universe

_ROOT: Final = Path(__file__).parents[2]
FOLDER: Final = _ROOT / "docs" / "reference" / "schemas"
# The editor validates universes with this schema. It is kept in the front end, which then builds without
# Python.
FOR_THE_EDITOR: Final = _ROOT / "frontend" / "src" / "generated" / "universe.schema.json"


def schemas() -> dict[str, str]:
    """Returns the text of each schema by file name."""
    document = {"$schema": "https://json-schema.org/draft/2020-12/schema", **Universe.model_json_schema()}
    return {"universe.schema.json": json.dumps(document, indent=2, ensure_ascii=False) + "\n"}


def main() -> None:
    """Writes every schema."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in schemas().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
    FOR_THE_EDITOR.write_text(schemas()["universe.schema.json"], encoding="utf-8")


if __name__ == "__main__":
    main()
