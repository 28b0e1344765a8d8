"""The tag for texts in templates."""

from __future__ import annotations

from django.template import Context, Template

from backend.accounts.templatetags import texts
from backend.accounts.texts import FALLBACK, catalogue


def test_a_template_shows_the_text_of_its_language() -> None:
    key = next(
        key for key, each in catalogue().items() if "{" not in each[FALLBACK] and "<" not in each[FALLBACK]
    )
    shown = Template(
        "{% load texts %}{% autoescape off %}{% text '" + key + "' %}{% endautoescape %}"
    ).render(Context())
    assert shown == texts.text(key)
