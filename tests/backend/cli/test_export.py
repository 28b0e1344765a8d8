"""`bt-studio export`."""

from __future__ import annotations

import zipfile

import pytest

from backend.cli.export import export
from backend.cli.new import new
from backend.cli.shared.errors import CliError


def test_a_stored_project_becomes_a_zip(stored_place):
    new("Rover")
    export("Rover", output=stored_place / "out.zip")
    with zipfile.ZipFile(stored_place / "out.zip") as made:
        assert "project.json" in made.namelist()
    with pytest.raises(CliError, match="no project named"):
        export("Missing")
