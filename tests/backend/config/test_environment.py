"""Settings that fail at start, by name."""

from __future__ import annotations

import pytest

from backend.config.environment import InvalidEnvironmentError, environment


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("port", "eighty"),
        ("port", "70000"),
        ("max_file_bytes", "0"),
        ("launcher", "magic"),
        ("allowed_hosts", "a,b"),
        ("log_level", "loud"),
        ("executor_hosts", '["https://robots.lan"]'),
        ("executor_hosts", '["robots.lan:0"]'),
        ("executor_hosts", f'["{"r" * 151}"]'),
        ("executor_hosts", '["robots.lan", "Robots.lan:7164"]'),
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


def test_hosts_have_a_port_and_need_containers(settings_of):
    settings_of(executor_hosts='["Robots.lan", "10.0.0.3:99", "[fd00::1]"]', launcher="docker")
    assert environment().executor_hosts == ("robots.lan:7164", "10.0.0.3:99", "[fd00::1]:7164")
    settings_of(launcher="process")
    with pytest.raises(InvalidEnvironmentError, match="BT_STUDIO_EXECUTOR_HOSTS needs"):
        environment()


def test_the_token_is_not_shown(settings_of):
    settings_of(token="s3cret")
    assert "s3cret" not in repr(environment())
