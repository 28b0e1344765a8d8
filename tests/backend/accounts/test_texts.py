"""The texts of the pages that Django renders."""

from __future__ import annotations

import pytest
from django.utils.translation import override

from backend.accounts.texts import FALLBACK, catalogue, text


def test_every_text_is_there_in_the_same_languages() -> None:
    languages = {frozenset(texts) for texts in catalogue().values()}
    assert len(languages) == 1
    assert FALLBACK in next(iter(languages))


def test_a_text_is_in_the_language_of_the_page() -> None:
    key = next(
        key for key, texts in catalogue().items() if "{" not in texts[FALLBACK] and texts["es"] != texts["en"]
    )
    for language, expected in (("es", "es"), ("es-mx", "es"), ("fi", "en")):
        with override(language):
            assert text(key) == catalogue()[key][expected]
    with pytest.raises(KeyError):
        text("no such text")
