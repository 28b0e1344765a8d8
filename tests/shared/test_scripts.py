"""The stored results, with which the editor's parser of scripts is tested, are those of the engine."""

from __future__ import annotations

import json

from tests.shared.make_scripts import FILE, document


def test_the_cases_are_up_to_date():
    assert json.loads(FILE.read_text(encoding="utf-8")) == document()
