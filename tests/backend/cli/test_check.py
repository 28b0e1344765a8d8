"""`bt-studio check`."""

from __future__ import annotations

import json

import pytest

from backend.cli.check import check
from backend.cli.shared.errors import CliError
from tests.executor.evaluation.projects import write

SOUND = '<root BTCPP_format="4"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>'


def test_a_sound_tree_has_no_errors(tmp_path, capsys):
    (tmp_path / "t.xml").write_text(SOUND)
    check(str(tmp_path / "t.xml"))
    assert capsys.readouterr().out.endswith("no errors\n")
    check(str(tmp_path / "t.xml"), as_json=True)
    assert json.loads(capsys.readouterr().out)["diagnostics"] == []


def test_a_wrong_one_ends_with_its_findings(tmp_path):
    (tmp_path / "t.xml").write_text(SOUND.replace("AlwaysSuccess", "Sequence"))
    with pytest.raises(CliError, match="BT0104"):
        check(str(tmp_path / "t.xml"))


def test_evaluations_are_checked_with_their_lines(tmp_path, capsys):
    sound = "duration_s: 1\nruns: 2\njudge: {success: [{reach: {area: ahead}}]}\n"
    check(str(write(tmp_path / "sound", sound)))
    assert "no errors" in capsys.readouterr().out
    wrong = write(tmp_path / "wrong", sound.replace("ahead", "nowhere"))
    with pytest.raises(CliError) as found:
        check(str(wrong))
    assert "evaluations/main.yaml:5:" in str(found.value)
    assert "no area 'nowhere'" in str(found.value)
