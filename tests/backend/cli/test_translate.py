"""`bt-studio translate`."""

from __future__ import annotations

import pytest

from backend.cli.shared.errors import CliError
from backend.cli.translate import translate

TREE = '<root BTCPP_format="4"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>'


def test_a_tree_is_printed_or_written(tmp_path, capsys):
    (tmp_path / "t.xml").write_text(TREE)
    translate(str(tmp_path / "t.xml"))
    assert "<AlwaysSuccess" in capsys.readouterr().out
    translate(str(tmp_path / "t.xml"), output=tmp_path / "out.xml")
    assert "<AlwaysSuccess" in (tmp_path / "out.xml").read_text()


def test_what_is_wrong_is_not_translated(tmp_path):
    (tmp_path / "t.xml").write_text("<root")
    with pytest.raises(CliError):
        translate(str(tmp_path / "t.xml"))
