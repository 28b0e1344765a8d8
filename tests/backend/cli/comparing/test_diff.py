"""`bt-studio diff`."""

from __future__ import annotations

import json
from typing import Any

import pytest

from backend.cli.comparing.diff import diff
from backend.cli.shared.errors import CliError
from tests.shared.make_differences import OLDER, changed


@pytest.fixture
def sides(tmp_path) -> dict[str, Any]:
    older, newer = tmp_path / "a.json", tmp_path / "b.json"
    older.write_text(json.dumps(OLDER))
    newer.write_text(json.dumps(changed(a={"ports": {"speed": "0.3", "gone": "x"}, "position": [5, 5]})))
    return {"older": str(older), "newer": str(newer)}


def test_lines_json_and_files(sides, tmp_path, capsys):
    diff(**sides)
    assert capsys.readouterr().out == "≠ tree MainTree changed\n  ≠ Forward [a]: speed: “0.2” → “0.3”\n"
    diff(**sides, as_json=True)
    assert json.loads(capsys.readouterr().out)["trees"][0]["operations"] == [
        {"op": "change", "node": "a", "field": "ports.speed", "before": "0.2", "after": "0.3"}
    ]
    diff(**sides, html=tmp_path / "d.html", picture=tmp_path / "d.svg")
    assert capsys.readouterr().out == ""
    assert (tmp_path / "d.html").read_text().startswith("<!DOCTYPE html>")
    assert (tmp_path / "d.svg").read_text().startswith("<svg ")


def test_layout_only_if_asked_for(sides, capsys):
    diff(**sides, layout=True)
    assert "position: “[1,2]” → “[5,5]”" in capsys.readouterr().out
    diff(sides["older"], sides["older"], layout=True)
    assert capsys.readouterr().out == ""


def test_what_cannot_be_read_ends_it(sides, tmp_path):
    (tmp_path / "bad.json").write_text("{")
    with pytest.raises(CliError, match="BT0001"):
        diff(sides["older"], str(tmp_path / "bad.json"))
