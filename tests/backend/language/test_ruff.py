"""Formatting and findings through the API."""

from __future__ import annotations

import sys

import pytest

from backend.config.environment import REPOSITORY
from backend.language import ruff


def test_a_source_is_formatted(api):
    answer = api.post("python/format", {"source": "x = {  'a':1 }\n", "filename": "actions/Go.py"})
    assert answer == {"source": 'x = {"a": 1}\n'}


def test_a_source_with_a_syntax_error_is_refused_with_its_place(api):
    problem = api.post("python/format", {"source": "def go(:\n    pass\n"}, expect=422)
    assert problem["code"] == "python_refused"
    assert problem["diagnostics"][0]["start"]["line"] == 1


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
    assert formatted == 'x = "a"\n'


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
    """A save of an example, a behaviour of the library or a node of Nav2 changes nothing by itself."""
    assert len(SHIPPED) > 20
    changed = []
    for path in SHIPPED:
        source = path.read_text(encoding="utf-8")
        if ruff.format_source(source, path.name, ruff.run_beside) != source:
            changed.append(path.relative_to(REPOSITORY).as_posix())
    assert changed == []
