"""Settings of a server with accounts: a missing or wrong one ends the start, and is named."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.config.environment import InvalidEnvironmentError, environment
from backend.config.team import database, mail
from tests.backend.serving import TIMEOUT_S, start

WHOLE = {
    "mode": "team",
    "public_url": "https://bt.example.org/",
    "database_url": "postgresql://bts:p%40ss@db:5433/studio?sslmode=require",
    "redis_url": "redis://redis:6379/0",
    "secret_key": "s" * 40,
    "launcher": "docker",
}
SQLITE = WHOLE | {"database_url": "sqlite:////data/team.sqlite3", "redis_url": ""}


def test_a_whole_set_is_taken(settings_of):
    settings_of(**WHOLE)
    found = environment()
    assert (found.is_team, found.is_https, found.public_host) == (True, True, "bt.example.org")
    options = database(found.database_url.get_secret_value(), Path("/data"))
    assert options["HOST"] == "db"
    assert options["PASSWORD"] == "p@ss"
    assert options["PORT"] == "5433"
    assert options["OPTIONS"]["sslmode"] == "require"


@pytest.mark.parametrize("name", ["public_url", "database_url", "redis_url", "secret_key"])
def test_what_is_missing_is_named(settings_of, name):
    settings_of(**{key: value for key, value in WHOLE.items() if key != name})
    with pytest.raises(InvalidEnvironmentError, match=f"BT_STUDIO_{name.upper()}"):
        environment()


@pytest.mark.parametrize("services", [WHOLE, SQLITE], ids=["PostgreSQL", "SQLite"])
@pytest.mark.parametrize("more", [{}, {"workers": 1}, {"unsafe_users_run_as_server": "false"}])
def test_users_python_does_not_run_as_the_server_unless_a_setting_says_so(settings_of, services, more):
    settings_of(**(services | more | {"launcher": "process"}))
    with pytest.raises(InvalidEnvironmentError, match="as the server itself") as caught:
        environment()
    assert "BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER=true" in str(caught.value)
    settings_of(unsafe_users_run_as_server="true")
    assert environment().users_run_as_server


@pytest.mark.parametrize("changes", [{"launcher": "docker"}, {"launcher": "kubernetes"}, {"mode": "local"}])
def test_where_users_are_isolated_or_there_is_one_no_such_setting_is_needed(settings_of, changes):
    settings_of(**(WHOLE | {"launcher": "process"} | changes))
    assert not environment().users_run_as_server


def test_the_default_launcher_ends_the_start_of_a_team_server_in_one_sentence(tmp_path):
    settings = {f"BT_STUDIO_{name.upper()}": value for name, value in SQLITE.items() if name != "launcher"}
    process = start(tmp_path, "--port", "0", **settings)
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert process.returncode == 2
    assert errors.startswith("BT_STUDIO_LAUNCHER: ")
    assert errors.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("mode", "cluster"),
        ("public_url", "bt.example.org"),
        ("public_url", "https://bt.example.org/path"),
        ("database_url", "mysql://db/studio"),
        ("database_url", "postgresql://db"),
        ("database_url", "sqlite:///relative"),
        ("redis_url", "http://redis"),
        ("secret_key", "short"),
        ("smtp_url", "http://mail"),
        ("oidc_issuer", "ftp://login"),
        ("proxy_hops", "-1"),
    ],
)
def test_what_is_wrong_is_named_and_secrets_are_not_shown(settings_of, name, value):
    settings_of(**(WHOLE | {name: value}))
    with pytest.raises(InvalidEnvironmentError, match=f"BT_STUDIO_{name.upper()}") as caught:
        environment()
    if name.endswith(("key", "database_url", "redis_url", "smtp_url")):
        assert f"'{value}'" not in str(caught.value)


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"smtp_url": "smtp://mail"}, "MAIL_FROM"),
        ({"oidc_issuer": "https://login.example"}, "OIDC_CLIENT_ID"),
    ],
)
def test_what_belongs_together_comes_together(settings_of, given, named):
    settings_of(**(WHOLE | given))
    with pytest.raises(InvalidEnvironmentError, match=f"BT_STUDIO_{named}"):
        environment()


def test_a_mail_servers_address_says_how_it_is_spoken_to():
    found = mail("smtp+starttls://me:p%40ss@mail.example", "bt@example.org")
    assert (found["EMAIL_HOST"], found["EMAIL_PORT"], found["EMAIL_USE_TLS"]) == ("mail.example", 587, True)
    assert found["EMAIL_HOST_PASSWORD"] == "p@ss"
    assert mail("smtps://mail.example", "x")["EMAIL_PORT"] == 465
    assert "dummy" in mail("", "")["EMAIL_BACKEND"]


def test_without_accounts_nobody_else_is_served(tmp_path):
    process = start(tmp_path, "--host", "0.0.0.0", "--port", "0")  # noqa: S104
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert process.returncode == 1
    assert "BT_STUDIO_MODE=team" in errors
