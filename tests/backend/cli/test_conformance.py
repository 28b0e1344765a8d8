"""`bt-studio conformance`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from backend.cli.conformance import conformance
from backend.cli.shared.errors import CliError

CASES = Path(__file__).resolve().parents[2] / "conformance" / "accepts.jsonl"


def test_cases_are_counted(capsys):
    conformance([CASES])
    assert "8" in capsys.readouterr().out


def test_a_file_that_is_not_there_is_said(tmp_path):
    with pytest.raises(CliError):
        conformance([tmp_path / "no.jsonl"])


def test_deviations_of_your_own_are_listed_with_their_reasons(tmp_path, capsys):
    rows = {"mine": {"kind": "more here", "reason": "we like it", "cases": ["*"]}}
    case = {
        "name": "one",
        "xml": '<root><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>',
        "rejected_410": True,
    }
    (tmp_path / "own.json").write_text(json.dumps(rows))
    (tmp_path / "cases.jsonl").write_text(json.dumps(case))
    conformance([tmp_path / "cases.jsonl"], deviations=tmp_path / "own.json")
    assert "mine (more here): we like it" in capsys.readouterr().out
    (tmp_path / "own.json").write_text("[]")
    with pytest.raises(CliError):
        conformance([tmp_path / "cases.jsonl"], deviations=tmp_path / "own.json")
