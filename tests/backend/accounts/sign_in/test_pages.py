"""The appearance and the texts of the pages that Django renders."""

from __future__ import annotations

from backend.accounts.texts import catalogue, text
from tests.backend.serving import REPOSITORY

OURS = REPOSITORY / "backend" / "accounts" / "static" / "accounts" / "tokens.css"
IDE = REPOSITORY / "frontend" / "src" / "ui" / "tokens.css"


def test_the_pages_have_the_colours_of_the_ide():
    assert OURS.read_text() == IDE.read_text(), f"run `make generate`: it copies {IDE} to {OURS}"


def test_every_text_exists_in_every_language():
    assert {frozenset(languages) for languages in catalogue().values()} == {frozenset({"en", "es"})}


def test_values_are_put_in():
    assert text("join_group", who="Tina", group="A & B") == "Tina invites you to “A & B”."


def test_the_page_of_the_api_asks_for_an_account_first(stranger, person):
    answer = stranger.page("/api/v1/docs")
    assert (answer.status_code, answer.headers["Location"]) == (
        302,
        "/accounts/login/?next=%2Fapi%2Fv1%2Fdocs",
    )
    assert person("ada").page("/api/v1/docs").status_code == 200
