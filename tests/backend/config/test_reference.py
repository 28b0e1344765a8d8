"""The stored reference pages equal the generated ones."""

from __future__ import annotations

from backend.config import reference


def test_the_pages_are_current():
    pages = reference.pages()
    assert {path.name for path in pages} == {"settings.md", "openapi.json"}
    for path, text in pages.items():
        assert path.read_text(encoding="utf-8") == text, "run python -m backend.config.reference"


def test_every_setting_says_what_it_does():
    for row in reference.settings_page().splitlines()[9:]:
        assert row.endswith(". |")


def test_every_operation_has_a_name_a_description_and_an_answer(db):
    from backend.config.schema_view import document

    names = set()
    for operations in document()["paths"].values():
        for operation in operations.values():
            assert operation["description"]
            assert "default" in operation["responses"]
            names.add(operation["operationId"])
    assert len(names) == sum(len(operations) for operations in document()["paths"].values())
