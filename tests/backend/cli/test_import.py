"""`bt-studio import`."""

from __future__ import annotations

import json

import pytest

from backend.cli.import_ import import_
from backend.cli.shared.errors import CliError

TREE = '<root BTCPP_format="4"><BehaviorTree ID="T"><Drive speed="1"/></BehaviorTree></root>'


def test_a_tree_becomes_a_project_with_stubs_of_its_actions(tmp_path, capsys):
    (tmp_path / "t.xml").write_text(TREE)
    import_(str(tmp_path / "t.xml"), tmp_path / "made", as_json=True)
    assert (tmp_path / "made" / "actions" / "Drive.py").is_file()
    assert json.loads(capsys.readouterr().out)


def test_nonsense_makes_nothing(tmp_path):
    (tmp_path / "t.xml").write_text("<root>&</root>")
    with pytest.raises(CliError):
        import_(str(tmp_path / "t.xml"), tmp_path / "made")
    assert not (tmp_path / "made").exists()
