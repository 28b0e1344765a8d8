"""Administration in the terminal."""

from __future__ import annotations

import zipfile

import pytest

from backend.accounts.models import User
from backend.cli import admin as commands
from backend.cli.shared.errors import CliError
from backend.config import server
from backend.sessions.lifecycle import drain
from tests.backend.accounts.test_sharing import project_of


@pytest.fixture
def terminal(person, monkeypatch, settings_of, tmp_path):
    """Django is set up already in the tests, and the database is that of the tests."""
    settings_of(data_dir=tmp_path)
    monkeypatch.setattr(server, "migrate", lambda: None)
    return tmp_path


def test_an_administrator_exports_and_deletes_a_user_in_the_terminal(person, terminal, capsys):
    olga = person("olga")
    one = project_of(olga)
    commands.export_user("olga@example.org", terminal / "olga.zip")
    assert f"projects/Robot ({one}).zip" in zipfile.ZipFile(terminal / "olga.zip").namelist()
    with pytest.raises(CliError, match="cannot be written"):
        commands.export_user("olga", terminal / "nowhere" / "olga.zip")
    with pytest.raises(CliError, match="no account"):
        commands.delete_user("otto", yes=True)
    commands.delete_user("olga", yes=True)
    assert not User.objects.filter(username="olga").exists()
    assert "olga is deleted, with 1 projects." in capsys.readouterr().out


def test_a_drain_begins_and_ends_in_the_terminal(person, terminal, capsys):
    person("ada", is_admin=True)
    commands.drain(message="Back at 15:00.")
    assert "Robots that run: 0." in capsys.readouterr().out
    assert drain.text().endswith("Back at 15:00.")
    commands.drain(off=True)
    assert drain.text() == ""


def test_the_first_administrator_is_made_once_and_has_a_link_until_a_password(person, terminal, capsys):
    person("olga")
    commands.create("ada", first=True)
    made = capsys.readouterr().out
    assert made.startswith("ada is made.")
    # A user who lost the link gets another one, whatever name is given, and no second administrator is made.
    commands.create("otto", first=True)
    again = capsys.readouterr().out
    assert again.startswith("ada is an administrator.")
    assert "/accounts/password/reset/key/" in again
    assert not User.objects.filter(username="otto").exists()
    ada = User.objects.get(username="ada")
    ada.set_password("a long password")
    ada.save()
    commands.create("ada", first=True)
    assert capsys.readouterr().out == "ada is an administrator.\n"


def test_an_administrator_who_was_deactivated_does_not_count(person, terminal, capsys):
    User.objects.filter(pk=person("ada", is_admin=True).user.pk).update(is_active=False)
    commands.create("otto", first=True)
    assert capsys.readouterr().out.startswith("otto is made.")
