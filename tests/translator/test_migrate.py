"""Diagrams of past versions become those of today."""

from __future__ import annotations

from translator.migrate import CURRENT_VERSION, MIGRATIONS, migrate


def test_a_diagram_without_a_number_gets_format_and_version() -> None:
    assert migrate({"root": "n1"}, 0) == {"format": "bt-studio/diagram", "root": "n1", "version": 2}


def test_a_diagram_of_today_stays() -> None:
    assert migrate({"root": "n1"}, CURRENT_VERSION) == {"root": "n1"}
    assert len(MIGRATIONS) == CURRENT_VERSION
