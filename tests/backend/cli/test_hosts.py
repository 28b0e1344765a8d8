"""Certificates of hosts in the terminal."""

from __future__ import annotations

import json

import pytest

from backend.cli import hosts as commands
from backend.cli.shared.errors import CliError
from tests.backend.sessions.hosts.conftest import authority, host_of


def test_a_certificate_is_made_for_a_host_of_the_list(settings_of, tmp_path, capsys):
    settings_of(data_dir=tmp_path, launcher="docker", executor_hosts='["Robots.lan", "[fd00::1]:99"]')
    for name in ("robots.lan", "[fd00::1]"):
        commands.certificate(name)
        printed = capsys.readouterr()
        assert printed.out.count("BEGIN CERTIFICATE") == 2
        assert printed.out.startswith("-----BEGIN PRIVATE KEY-----")
        assert "is valid until 20" in printed.err
    assert (tmp_path / "hosts" / "web.pem").exists()


def test_a_host_that_is_not_on_the_list_gets_none(settings_of, tmp_path, capsys):
    settings_of(data_dir=tmp_path)
    with pytest.raises(CliError, match="BT_STUDIO_EXECUTOR_HOSTS, which is empty"):
        commands.certificate("robots.lan")
    assert capsys.readouterr().out == ""
    assert not (tmp_path / "hosts").exists()


def test_a_folder_that_cannot_be_used_is_one_sentence(settings_of, tmp_path):
    (tmp_path / "hosts").write_text("")
    settings_of(data_dir=tmp_path, launcher="docker", executor_hosts='["robots.lan"]')
    with pytest.raises(CliError, match="cannot be used"):
        commands.certificate("robots.lan")


def test_hosts_say_how_many_executors_may_start(settings_of, host_of, capsys):
    well, gone = host_of(2, BT_STUDIO_MAX_SESSIONS="7"), host_of(3)
    gone.kill("relay")
    settings_of(launcher="docker", executor_hosts=json.dumps([str(well.address), str(gone.address)]))
    with pytest.raises(CliError, match=rf"{gone.address}: .* is not reached"):
        commands.check()
    assert f"{well.address}: 7 of 7 executors may start" in capsys.readouterr().out
    settings_of(executor_hosts=json.dumps([str(well.address)]))
    commands.check()
    settings_of(executor_hosts="[]")
    with pytest.raises(CliError, match="is empty"):
        commands.check()


__all__ = ["authority", "host_of"]
