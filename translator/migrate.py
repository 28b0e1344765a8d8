"""Numbered migrations of the diagram format: entry n turns version n into version n + 1."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

CURRENT_VERSION = 2
PLAIN_VERSION = 1
"""The version of diagrams that use nothing of the current one, so that earlier programs read them."""


def _name_the_format(document: dict[str, Any]) -> dict[str, Any]:
    """Migrates version 0 to 1: adds the fields `format` and `version`."""
    return {"format": "bt-studio/diagram", **document, "version": 1}


def _allow_silence(document: dict[str, Any]) -> dict[str, Any]:
    """Migrates version 1 to 2: nodes may have `silenced`, which none of them has yet."""
    return {**document, "version": 2}


MIGRATIONS: tuple[Callable[[dict[str, Any]], dict[str, Any]], ...] = (_name_the_format, _allow_silence)


def migrate(document: dict[str, Any], version: int) -> dict[str, Any]:
    """Returns the document in the current version; `version` must be one of the past or the current."""
    for step in MIGRATIONS[version:CURRENT_VERSION]:
        document = step(document)
    return document
