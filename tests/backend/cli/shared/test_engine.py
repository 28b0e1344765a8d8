"""An engine of another version beside bt-studio."""

from __future__ import annotations

import pytest

import tree_gardener
from backend import __version__
from backend.cli.main import main
from backend.cli.shared.engine import require_engine
from backend.cli.shared.errors import CliError


def test_the_engine_of_this_version_is_right():
    require_engine()


@pytest.mark.parametrize("other", ["0.0.1", "99.0"])
def test_another_one_is_refused_with_both_versions_and_its_place(monkeypatch, other):
    monkeypatch.setattr(tree_gardener, "__version__", other)
    with pytest.raises(CliError) as refused:
        require_engine()
    [sentence] = refused.value.lines
    assert f"needs tree-gardener {__version__}" in sentence
    assert f"tree_gardener is {other}:" in sentence


def test_a_command_says_so_and_does_nothing(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(tree_gardener, "__version__", "99.0")
    monkeypatch.setattr("sys.argv", ["bt-studio", "new", str(tmp_path / "mine")])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 1
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "mine").exists()
