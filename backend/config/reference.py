"""Writes the reference pages that are generated from code: `python -m backend.config.reference`.

A test compares the pages with the output of this module.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from pydantic import SecretStr

from backend.config.environment import PREFIX, REPOSITORY, Environment
from backend.core.processes.memory import MEBIBYTE

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

FOLDER: Final = REPOSITORY / "docs" / "reference"
HEAD: Final = """# Settings

<!-- Written by `python -m backend.config.reference`; change `backend/config/environment.py` instead. -->

`bt-studio serve` reads these variables of the environment. A value that cannot be used ends the start with
the name of its variable.

| variable | default | what it sets |
| --- | --- | --- |
"""


def settings_page() -> str:
    """Returns the page of all settings."""
    rows = [
        f"| `{PREFIX}{name.upper()}` | {_default(field)} | {field.description} |"
        for name, field in Environment.model_fields.items()
    ]
    return HEAD + "\n".join(rows) + "\n"


def _default(field: FieldInfo) -> str:
    value = field.default
    if isinstance(value, SecretStr):
        value = value.get_secret_value()
    if isinstance(value, Path) and value.is_relative_to(REPOSITORY):
        value = value.relative_to(REPOSITORY)
    if isinstance(value, int) and value >= MEBIBYTE and value % MEBIBYTE == 0:
        return f"{value // MEBIBYTE} MiB (`{value}`)"
    return f"`{value}`" if value not in ("", ()) else "–"


def openapi_page() -> str:
    """Returns the OpenAPI document, from which clients are generated."""
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    import django  # noqa: PLC0415 - the settings must be named first

    django.setup()
    from backend.config.schema_view import document  # noqa: PLC0415

    return json.dumps(document(), ensure_ascii=False, indent=2) + "\n"


def pages() -> dict[Path, str]:
    """Returns every generated page of this part by its path."""
    return {FOLDER / "settings.md": settings_page(), FOLDER / "openapi.json": openapi_page()}


def main() -> None:
    """Writes the pages."""
    for path, text in pages().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        sys.stdout.write(f"{path.relative_to(REPOSITORY)}\n")


if __name__ == "__main__":
    main()
