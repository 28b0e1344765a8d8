"""What administrators do on their pages and in the terminal."""

from __future__ import annotations

import zipfile
from typing import Any

import pytest
from django.conf import settings

from backend.accounts.models import AuditEntry, User
from backend.accounts.signals_out import account_leaves
from backend.cli import admin as commands
from backend.cli.errors import CliError
from backend.config import server
from backend.sessions import drain
from backend.sessions import writes as session_writes
from tests.backend.accounts.test_sharing import project_of


@pytest.fixture
def terminal(person, monkeypatch, settings_of, tmp_path):
    """Django is set up already in the tests, and the database is that of the tests."""
    settings_of(data_dir=tmp_path)
    monkeypatch.setattr(server, "migrate", lambda: None)
    return tmp_path


def test_an_administrator_deletes_an_account_as_its_user_would(person):
    ada, olga = person("ada", is_admin=True), person("olga")
    project_of(olga)
    left = []
    account_leaves.connect(lambda sender, user, **_: left.append(user.username), weak=False)
    ada.form(f"/admin/accounts/user/{olga.user.pk}/delete/", post="yes")
    assert left == ["olga"]
    assert not User.objects.filter(username="olga").exists()
    answer = ada.form(f"/admin/accounts/user/{ada.user.pk}/delete/", post="yes")
    assert b"only administrator" in ada.page(answer["Location"]).content
    chosen = {"action": "delete_selected", "_selected_action": str(ada.user.pk), "post": "yes"}
    ada.form("/admin/accounts/user/", **chosen)
    assert User.objects.filter(username="ada").exists()


def test_before_an_upgrade_no_robot_starts_and_users_are_told_why(person, monkeypatch):
    monkeypatch.setattr(session_writes, "workers", type("Idle", (), {"submit": lambda *_: None}))
    ada, olga = person("ada", is_admin=True), person("olga")
    running, waiting = project_of(olga), project_of(olga, "Later")
    olga.post(f"projects/{running}/session")
    page = "/admin/executor_sessions/session/"
    assert b"Let no robot start" in ada.page(page).content
    token = ada.client.cookies[settings.CSRF_COOKIE_NAME].value
    ada.client.post(
        "/admin/executor_sessions/session/drain/",
        {"message": "Back at 15:00.", "csrfmiddlewaretoken": token},
    )
    assert b"Back at 15:00." in ada.page("/admin/executor_sessions/session/").content
    refused = olga.post(f"projects/{waiting}/session", expect=503)
    assert (refused["code"], refused["hint"]) == ("draining", "Back at 15:00.")
    olga.post(f"projects/{running}/session")  # what runs goes on
    assert session_writes.start_queued() == 0
    assert drain.text().endswith("those that run continue. Back at 15:00.")
    told: list[Any] = []
    assert drain.wait_for_the_last(0, told.append) == 1
    assert told == ["Robots that run: 1. Users who wait for one: 0."]
    drain.lift(acting_user=ada.user)
    assert drain.text() == ""
    olga.post(f"projects/{waiting}/session")
    log = AuditEntry.objects.filter(action__startswith="server.").order_by("id")
    assert [(row.actor_name, row.action) for row in log] == [
        ("ada", "server.drain"),
        ("ada", "server.drain_off"),
    ]


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
    # Whoever missed the link gets another, whatever name is given, and no second administrator.
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
