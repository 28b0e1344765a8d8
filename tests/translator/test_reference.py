"""The generated reference is up to date, and the table of diagnostics is whole."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import translator
from translator.diagnostic import Place, diagnostic, rules
from translator.reference import FOLDER, GROUPS, pages

OWN = Path(translator.__file__).parent
# Some are reported by the web server alone, such as that a project could not be checked at all.
SERVER = OWN.parent / "backend"
SOURCES = {path: path.read_text() for path in (*OWN.rglob("*.py"), *SERVER.rglob("*.py"))}
USED = set(re.findall(r'"(BT\d{4})"', "".join(SOURCES.values())))


@pytest.mark.parametrize("path", pages())
def test_page_is_what_the_script_makes(path):
    assert (FOLDER / path).read_text(encoding="utf-8") == pages()[path], "run: python -m translator.reference"


def test_codes_in_the_table_are_those_in_the_code():
    assert set(rules()) == USED
    assert list(rules()) == sorted(rules())
    assert {code[:4] for code in rules()} == set(GROUPS)


@pytest.mark.parametrize("code", rules())
def test_row_is_worded_for_users(code):
    rule = rules()[code]
    fields = set(re.findall(r"(?<!\{)\{(\w+)\}", rule.message + rule.hint))
    found = diagnostic(code, Place("f"), **dict.fromkeys(fields, "x"))
    assert found.message
    assert found.hint
    for word in ("IR", "parser", "exception", "None", "traceback", "null", "ast", "lxml", "expat"):
        assert not re.search(rf"\b{word}\b", rule.message + rule.hint), word
