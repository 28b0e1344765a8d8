"""The template tag `{% text "key" name=value %}`, which renders a text in the page's language."""

from __future__ import annotations

from django import template

from backend.accounts.texts import text as find

register = template.Library()


@register.simple_tag
def text(key: str, **values: object) -> str:
    """Renders a text in the language of the page."""
    return find(key, **values)
