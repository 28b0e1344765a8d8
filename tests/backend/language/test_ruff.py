"""Formatting and findings through the API."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from backend.config.environment import REPOSITORY
from backend.language import ruff

TEMPLATES = sorted(Path(__file__).parents[3].glob("frontend/src/features/code/templates/*.py"))


def test_a_source_is_formatted(api):
    answer = api.post("python/format", {"source": "x = {  'a':1 }\n", "filename": "actions/Go.py"})
    assert answer == {"source": 'x = {"a": 1}\n', "findings": []}


def test_a_source_with_a_syntax_error_stays_as_it_is_with_its_place(api):
    source = "def go(:\n    pass\n"
    answer = api.post("python/format", {"source": source})
    assert answer["source"] == source
    assert {each["severity"] for each in answer["findings"]} == {"error"}
    assert answer["findings"][0]["start"]["line"] == 1


def test_findings_come_with_the_edits_that_fix_them(api):
    source = "import os\nimport py_trees\nprint(py_trees)\n"
    [finding] = api.post("python/lint", {"source": source})["findings"]
    assert finding["code"] == "F401"
    assert finding["start"] == {"line": 1, "column": 8}
    [edit] = finding["fix"]["edits"]
    assert edit == {"start": {"line": 1, "column": 1}, "end": {"line": 2, "column": 1}, "content": ""}


def test_a_configuration_beside_it_has_no_say(tmp_path, monkeypatch):
    (tmp_path / "ruff.toml").write_text("[format]\nquote-style = 'single'\n")
    monkeypatch.chdir(tmp_path)
    formatted = ruff.format_source("x = 'a'\n", str(tmp_path / "Go.py"), ruff.run_beside)
    assert formatted["source"] == 'x = "a"\n'


@pytest.mark.parametrize("path", ["python/format", "python/lint"])
def test_a_source_beyond_reason_is_refused(api, path):
    api.post(path, {"source": "x" * 1_048_577}, expect=422)
    api.post(path, {"source": "é" * 600_000}, expect=422)


def test_a_checker_that_hangs_is_given_up(monkeypatch, api, tmp_path):
    slow = tmp_path / "ruff"
    slow.write_text("#!/bin/sh\nexec sleep 60\n")
    slow.chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    monkeypatch.setattr(ruff, "TIMEOUT_S", 0.2)
    assert api.post("python/lint", {"source": "x"}, expect=422)["code"] == "python_refused"


SHIPPED = sorted(
    path
    for folder in ("examples", "backend/catalog/behaviours", "tree_gardener/nav2")
    for path in (REPOSITORY / folder).rglob("*.py")
)


def test_what_is_shipped_stays_as_it_is_when_a_user_formats_it():
    """Saving an example, a behaviour of the library or a node of Nav2 changes nothing by itself."""
    assert len(SHIPPED) > 20
    changed = []
    for path in SHIPPED:
        source = path.read_text(encoding="utf-8")
        if ruff.format_source(source, path.name, ruff.run_beside)["source"] != source:
            changed.append(path.relative_to(REPOSITORY).as_posix())
    assert changed == []


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda path: path.stem)
def test_a_template_is_born_without_a_finding_and_formatted(path):
    source = path.read_text(encoding="utf-8")
    assert ruff.findings(source, "actions/NewAction.py", ruff.run_beside) == []
    assert ruff.format_source(source, "actions/NewAction.py", ruff.run_beside)["source"] == source
