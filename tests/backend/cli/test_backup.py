"""`bt-studio backup`."""

from __future__ import annotations

import pytest

from backend.cli.backup import backup
from backend.cli.new import new
from backend.cli.shared.errors import CliError


def test_everything_is_written_to_one_file(stored_place, capsys):
    new("Rover")
    capsys.readouterr()
    backup(stored_place / "all.zip")
    assert (stored_place / "all.zip").stat().st_size > 0
    with pytest.raises(CliError):
        backup(stored_place / "nowhere" / "all.zip")
