"""A publisher is reached by the user's own ssh."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from backend.cli.debugging.tunnel import reached
from backend.cli.shared.errors import CliError
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import XML
from tree_gardener import Tree
from tree_gardener.groot import Groot2Publisher
from tree_gardener.groot.client import Groot2Client

ROOT = Path(__file__).parents[4]


@pytest.fixture
def asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Puts a fake `ssh` on the path; returns the file of its arguments."""
    program = tmp_path / "ssh"
    program.write_text(f'#!/bin/sh\ncd {ROOT} && exec {sys.executable} -m tests.fakes.ssh "$@"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("FAKE_SSH", str(tmp_path / "asked"))
    return tmp_path / "asked"


def test_both_ports_are_forwarded_and_ssh_ends_with_the_block(asked: Path) -> None:
    port = free_port()
    with (
        Groot2Publisher(Tree.from_xml(XML), port),
        reached(f"ssh://pilot@robot:{port}") as robot,
        Groot2Client(robot.host, near := robot.port, 60.0) as client,
    ):
        assert near != port
        robot.check()
        assert [node.path for node in client.tree().nodes[:2]] == ["top", "Script"]
    words = asked.read_text().splitlines()
    assert words[-2:] == ["--", "pilot@robot"]
    assert [word for word in words if word.startswith("127.0.0.1:")] == [
        f"127.0.0.1:{near + more}:localhost:{port + more}" for more in (0, 1)
    ]
    with pytest.raises(CliError, match="cannot be reached any more"):
        robot.check()


@pytest.mark.usefixtures("asked")
def test_an_ssh_that_ends_is_said() -> None:
    with pytest.raises(CliError, match="ssh to refused ended with status 255"), reached("ssh://refused"):
        pass


def test_a_missing_ssh_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(CliError, match="ssh is not installed"), reached("ssh://robot"):
        pass


@pytest.mark.parametrize(
    ("address", "why"),
    [
        ("ssh://-oProxyCommand=x@robot", "no name of a user"),
        ("ssh://-oProxyCommand", "takes it for an option"),
        ("ssh://a b@robot", "no name of a user"),
        ("ssh://robot:0", "no port"),
        ("ssh://pilot@robot/tree", "more than a host and a port"),
        ("ssh://", "no host and port"),
        ("pilot@robot", "more than a host and a port"),
        ("ipc:///tmp/x", "ipc"),
    ],
)
def test_other_addresses_are_refused(address: str, why: str) -> None:
    with pytest.raises(CliError, match=why) as raised, reached(address):
        pass
    assert raised.value.status == 2


def test_a_host_is_asked_itself() -> None:
    with reached("robot.local:1700") as found:
        assert (found.host, found.port) == ("robot.local", 1700)
        found.check()
