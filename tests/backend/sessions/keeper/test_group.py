"""Whether the keeper may use Docker's socket, and its message if it may not."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from backend.sessions.keeper.errors import KeeperError
from backend.sessions.keeper.group import check_socket


@pytest.fixture
def docker_socket(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the path of a socket holds 107 bytes
    with socket.socket(socket.AF_UNIX) as made:
        made.bind("docker.sock")
        (tmp_path / "docker.sock").chmod(0o660)
        yield "docker.sock"


@pytest.fixture
def shut_out(monkeypatch):
    """Acts as a user who is neither root nor in the group."""
    monkeypatch.setattr(os, "access", lambda *_: False)


def test_a_socket_that_can_be_used_is_used(docker_socket):
    check_socket(docker_socket)


def test_the_group_that_it_takes_is_named(docker_socket, shut_out):
    group = Path(docker_socket).stat().st_gid
    with pytest.raises(KeeperError, match=f"to group {group}.*Set BT_STUDIO_DOCKER_GID={group} in docker"):
        check_socket(docker_socket)


def test_a_socket_that_shuts_its_group_out_is_named(docker_socket, shut_out):
    Path(docker_socket).chmod(0o600)
    with pytest.raises(KeeperError, match="keeper_group: The mode 0600"):
        check_socket(docker_socket)


def test_what_is_no_socket_is_named(tmp_path):
    with pytest.raises(KeeperError, match="docker_missing: There is no"):
        check_socket(str(tmp_path / "none"))
    # Docker makes a folder where the path of a mount does not exist.
    with pytest.raises(KeeperError, match=r"docker_missing: .* is no socket. Set BT_STUDIO_DOCKER_SOCKET"):
        check_socket(str(tmp_path))
