"""The verbs that work on stored projects."""

from __future__ import annotations

import io
import json
import zipfile

import pytest

from backend.cli.export import export
from backend.cli.new import new
from backend.cli.projects import projects
from backend.cli.shared import stored
from backend.cli.shared.errors import CliError
from backend.config import server


@pytest.fixture(autouse=True)
def data_folder(db, monkeypatch, settings_of, tmp_path):
    """Django is set up already in the tests, and the database is that of the tests."""
    settings_of(data_dir=tmp_path)
    monkeypatch.setattr(server, "migrate", lambda: None)


def test_a_project_is_made_listed_and_exported(capsys, tmp_path):
    new("Rover", template="laser_bump_and_go")
    projects()
    assert "Rover" in capsys.readouterr().out
    projects("nothing")
    assert capsys.readouterr().out == ""
    projects(as_json=True)
    (row,) = json.loads(capsys.readouterr().out)
    for name in ("rover", row["id"]):
        target = tmp_path / "out.zip"
        export(name, output=target)
        with zipfile.ZipFile(io.BytesIO(target.read_bytes())) as archive:
            assert "actions/Turn.py" in archive.namelist()


def test_errors_are_one_line():
    new("Rover")
    with pytest.raises(CliError, match=r"name_taken: .*Rover"):
        new("Rover")
    with pytest.raises(CliError, match=r"no project named"):
        export("Missing")
    with pytest.raises(CliError, match=r"empty, .*laser"):
        new("Other", template="nonsense")


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    new("Rover")
    with pytest.raises(CliError, match="nowhere"):
        export("Rover", output=tmp_path / "nowhere" / "x.zip")


def test_a_stored_project_is_found_by_name_or_id():
    new("Rover")
    with stored.stored_projects():
        found = stored.find_project("ROVER")
        assert stored.find_project(str(found.id)) == found
