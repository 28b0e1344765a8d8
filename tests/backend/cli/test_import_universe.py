"""`bt-studio import-universe`."""

from __future__ import annotations

import json

import pytest

from backend.cli.import_universe import import_universe
from backend.cli.shared.errors import CliError
from executor.universes import parse_universe

SDF = """\
<sdf version="1.9"><world name="yard"><physics/>
<model name="crate"><static>1</static><link name="link"><collision name="c"/>
<visual name="visual"><geometry><box><size>1 1 1</size></box></geometry></visual></link></model></world></sdf>
"""


def test_a_world_becomes_a_universe_and_the_rest_is_reported(tmp_path, capsys):
    source = tmp_path / "yard.sdf"
    source.write_text(SDF)
    import_universe(source)
    said = capsys.readouterr().out
    assert "1 things" in said
    assert "yard.sdf:1: <physics> has no counterpart here" in said
    assert [model.id for model in parse_universe((tmp_path / "yard.yaml").read_text()).models] == ["crate"]
    import_universe(source, output=tmp_path / "other.yaml", as_json=True)
    assert json.loads(capsys.readouterr().out)["left_out"][0]["line"] == 1


def test_what_cannot_be_done_is_said(tmp_path):
    source = tmp_path / "yard.sdf"
    with pytest.raises(CliError, match="No such file"):
        import_universe(source)
    source.write_text("<sdf><world>")
    with pytest.raises(CliError, match=r"yard\.sdf:1:"):
        import_universe(source)
    (tmp_path / "yard.yaml").write_text("mine")
    with pytest.raises(CliError, match="exists already"):
        import_universe(source)
    assert (tmp_path / "yard.yaml").read_text() == "mine"
