"""`bt-studio conformance`."""

from __future__ import annotations

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
