"""Answers of the advisory services, and what no answer means."""

from __future__ import annotations

import json

import pytest

from tests.tools.audit import Answer, read_npm, read_pip, report

FLAW = {"id": "PYSEC-1", "fix_versions": ["1.1"], "aliases": [], "description": ""}
REFUSED = {"message": "405 Method Not Allowed - POST https://example.org/bulk", "error": {"summary": ""}}
CLEAN = {"vulnerabilities": {}, "metadata": {"dependencies": {"total": 7}}}
SICK = {
    "vulnerabilities": {
        "b": {"range": "<2", "severity": "high", "via": [{"title": "It leaks"}]},
        "a": {"range": "*", "severity": "low", "via": ["b"]},
    },
    "metadata": {"dependencies": {"total": 7}},
}


def dependencies(*rows):
    return json.dumps({"dependencies": rows, "fixes": []})


def test_flaws_of_python_packages_are_reported_with_the_fixed_versions():
    sound, flawed = (
        {"name": "a", "version": "1", "vulns": []},
        {"name": "b", "version": "1.0", "vulns": [FLAW]},
    )
    lost = {"name": "c", "skip_reason": "not found"}
    found = read_pip(dependencies(sound, flawed, lost), "")
    assert found == Answer(3, ("b 1.0: PYSEC-1, fixed in 1.1",), ("c",))


def test_flaws_of_npm_packages_are_reported():
    assert read_npm(json.dumps(CLEAN), "") == Answer(7)
    assert read_npm(json.dumps(SICK), "").known == ("a *: low", "b <2: high, It leaks")


@pytest.mark.parametrize(
    "answer",
    [
        read_pip("", "ERROR:pip_audit: Could not connect"),
        read_pip(dependencies({"name": "a", "skip_reason": "not found"}), ""),
        read_npm("", "npm: No such file"),
        read_npm(json.dumps(REFUSED), ""),
    ],
)
def test_a_service_that_cannot_be_asked_is_no_clean_report(answer, capsys):
    assert answer.trouble
    assert report("npm", answer) == 2
    assert "NOT asked" in capsys.readouterr().out


def test_the_status_says_whether_anything_is_known(capsys):
    assert (report("npm", Answer(7)), report("npm", Answer(7, ("a",)))) == (0, 1)
    assert "7 packages, no known vulnerabilities" in capsys.readouterr().out
