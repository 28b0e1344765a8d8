"""Texts of the pages that Django renders, in every language of the IDE; allauth has its own."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Final

from django.utils.translation import get_language

FALLBACK: Final = "en"


@lru_cache(maxsize=1)
def catalogue() -> dict[str, dict[str, str]]:
    """Returns all texts: by key, then by language."""
    found: dict[str, dict[str, str]] = json.loads(
        Path(__file__).with_name("texts.json").read_text(encoding="utf-8")
    )
    return found


def text(key: str, **values: object) -> str:
    """Returns a text in the language of the page.

    Raises:
        KeyError: there is no such text, or one of its values is missing.
    """
    languages = catalogue()[key]
    language = (get_language() or FALLBACK).partition("-")[0]
    return languages.get(language, languages[FALLBACK]).format(**values)
