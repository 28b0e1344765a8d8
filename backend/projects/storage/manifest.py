"""Reads and writes `project.json`: the fields that lists show, and edits that preserve the other fields."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from backend.core.limits import LIMITS
from backend.core.problems import InvalidInputError
from backend.projects.storage import names

if TYPE_CHECKING:
    from collections.abc import Mapping

MANIFEST: Final = "project.json"


@dataclass(frozen=True, slots=True)
class Manifest:
    """The fields of `project.json` that are also columns of the project's row."""

    name: str
    description: str
    main_tree: str
    universe: str
    document: Mapping[str, Any]


def read(raw: bytes) -> Manifest:
    """Reads a `project.json`.

    Raises:
        InvalidInputError: the file is not a JSON object, or one of these fields is not a text or is too long.
    """
    try:
        document = json.loads(raw.decode("utf-8-sig"), parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise InvalidInputError(f"project.json is not valid JSON: {error}.", field=MANIFEST) from error
    if not isinstance(document, dict):
        raise InvalidInputError("project.json must hold a JSON object.", field=MANIFEST)
    if document.get("format", "bt-studio/project") != "bt-studio/project" or document.get("version", 1) != 1:
        raise InvalidInputError(
            "project.json has a format that this version does not know.",
            hint="It should say format bt-studio/project, version 1.",
            field=MANIFEST,
        )
    return Manifest(
        name=names.project_name(_text(document, "name", "Untitled", 10 * names.MAX_NAME_LENGTH)),
        description=_text(document, "description", "", LIMITS["description_characters"]),
        main_tree=_text(document, "main_tree", "MainTree", names.MAX_NAME_LENGTH),
        universe=_text(document, "universe", "empty", names.MAX_NAME_LENGTH),
        document=document,
    )


def write(document: Mapping[str, Any]) -> bytes:
    """Returns the bytes of a `project.json`; equal documents give equal bytes."""
    return (json.dumps(document, ensure_ascii=False, indent=2) + "\n").encode()


def _text(document: Mapping[str, Any], field: str, default: str, limit: int) -> str:
    value = document.get(field, default)
    if not isinstance(value, str):
        raise InvalidInputError(f"{field} in project.json must be text.", field=f"{MANIFEST}.{field}")
    if len(value) > limit or "\0" in value:
        raise InvalidInputError(
            f"{field} in project.json has at most {limit} characters, none of them NUL.",
            field=f"{MANIFEST}.{field}",
        )
    return value


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is not a JSON number")
