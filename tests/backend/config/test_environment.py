"""Settings that fail at start, by name."""

from __future__ import annotations

import re

import pytest

from backend.config.environment import REMOVED, REPOSITORY, InvalidEnvironmentError, environment


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("port", "eighty"),
        ("port", "70000"),
        ("max_file_bytes", "0"),
        ("launcher", "magic"),
        ("allowed_hosts", "a,b"),
        ("log_level", "loud"),
    ],
)
def test_a_wrong_value_is_refused_with_the_name_of_its_variable(settings_of, name, value):
    settings_of(**{name: value})
    with pytest.raises(InvalidEnvironmentError, match=f"BT_STUDIO_{name.upper()}"):
        environment()


def test_values_are_read_and_paths_made_absolute(settings_of, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    settings_of(data_dir="here", port=0, allowed_hosts='["studio.lan"]')
    assert environment().data_dir == tmp_path / "here"
    assert environment().allowed_hosts == ("studio.lan",)


@pytest.mark.parametrize("name", list(REMOVED))
def test_a_setting_of_an_earlier_release_says_what_to_use_instead(settings_of, name):
    settings_of(**{name: '["robots.lan"]'})
    with pytest.raises(InvalidEnvironmentError, match=f"BT_STUDIO_{name}: this setting is gone") as refused:
        environment()
    page = re.search(r"docs/[\w/-]+\.md", str(refused.value))
    assert page
    assert (REPOSITORY / page[0]).is_file()


@pytest.mark.parametrize("value", ["", "[]"])
def test_a_compose_file_of_an_earlier_release_that_sets_nothing_opens(settings_of, value):
    settings_of(**dict.fromkeys(REMOVED, value))
    environment()


def test_the_token_is_not_shown(settings_of):
    settings_of(token="s3cret")
    assert "s3cret" not in repr(environment())
