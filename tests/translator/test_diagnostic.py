"""Findings: their text, their place and the table of codes."""

from __future__ import annotations

import pytest

from translator.diagnostic import Place, Severity, TranslatorError, diagnostic, errors_in, rules

PLACE = Place("trees/A.json", tree="A", node="n1", line=3, column=7)


def test_a_finding_is_filled_from_the_table_and_prints_as_one_line() -> None:
    found = diagnostic("BT0001", PLACE, problem="it ends too early")
    assert "it ends too early" in found.message
    assert str(found).startswith("trees/A.json:3:7: BT0001 [n1] ")
    assert found.to_json()["values"] == {"problem": "it ends too early"}


def test_a_finding_moves_and_stays_the_same_otherwise() -> None:
    found = diagnostic("BT0001", PLACE, problem="x")
    assert found.moved(line=9).place == Place("trees/A.json", tree="A", node="n1", line=9, column=7)
    assert found.moved(line=9).message == found.message


def test_a_value_that_the_table_wants_must_be_given() -> None:
    with pytest.raises(KeyError):
        diagnostic("BT0001", PLACE)


def test_an_error_of_the_translator_lists_its_findings() -> None:
    error = diagnostic("BT0001", PLACE, problem="x")
    note = next(code for code, rule in rules().items() if rule.severity is Severity.NOTE)
    assert rules()[note].severity is not Severity.ERROR
    assert errors_in([error]) == (error,)
    assert str(TranslatorError([error])) == str(error)
