"""The stored findings, with which the editor's checks are tested, are those of the translator."""

from __future__ import annotations

import json

from tests.shared.make_problems import FILE, KINDS, text
from translator.diagnostic import rules


def test_the_cases_are_up_to_date():
    assert FILE.read_text(encoding="utf-8") == text(), "run python -m tests.shared.make_problems"


def test_what_the_editor_judges_are_findings_of_the_translator():
    kinds = json.loads(KINDS.read_text(encoding="utf-8"))
    assert {code for codes in kinds.values() for code in codes} <= set(rules())
