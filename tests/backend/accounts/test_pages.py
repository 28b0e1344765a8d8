"""The look and the words of the pages that Django draws."""

from __future__ import annotations

from backend.accounts.texts import catalogue, text
from tests.backend.serving import REPOSITORY

OURS = REPOSITORY / "backend" / "accounts" / "static" / "accounts" / "tokens.css"
IDE = REPOSITORY / "frontend" / "src" / "ui" / "tokens.css"


def test_the_pages_have_the_colours_of_the_ide():
    assert OURS.read_text() == IDE.read_text(), f"copy {IDE} to {OURS}"


def test_every_text_exists_in_every_language():
    assert {frozenset(languages) for languages in catalogue().values()} == {frozenset({"en", "es"})}


def test_values_are_put_in():
    assert text("join_group", who="Tina", group="A & B") == "Tina invites you to “A & B”."
