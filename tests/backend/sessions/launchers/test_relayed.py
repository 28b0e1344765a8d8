"""A host that does not answer costs one wait, not one for each of its sessions."""

from __future__ import annotations

import socket

import pytest

from backend.sessions.errors import LaunchError
from backend.sessions.hosts.authority import renew_web_bundle
from backend.sessions.hosts.dial import web_bundle
from backend.sessions.hosts.names import HostAddress
from backend.sessions.launchers.relayed import PAUSE_S, RelayedLauncher

SESSION = "0f6a1a8f-1d0a-4c5e-9b57-6f0b2f0e6c11"


class CountingListener:
    """Accepts connections and closes them."""

    def __init__(self):
        self.socket = socket.create_server(("127.0.0.1", 0))
        self.socket.settimeout(0)

    @property
    def callers(self):
        number = 0
        while True:
            try:
                self.socket.accept()[0].close()
            except BlockingIOError:
                return number
            number += 1


@pytest.fixture
def listener():
    made = CountingListener()
    yield made
    made.socket.close()


def test_a_host_that_did_not_answer_is_left_alone_for_a_moment(listener, settings_of, tmp_path, monkeypatch):
    settings_of(data_dir=tmp_path)
    web_bundle.cache_clear()
    renew_web_bundle(tmp_path / "hosts")
    monkeypatch.setattr("backend.sessions.launchers.relayed.CONNECT_S", 0.2)
    now_s = [0.0]
    launcher = RelayedLauncher(HostAddress("127.0.0.1", listener.socket.getsockname()[1]), lambda: now_s[0])
    for _ in range(10):
        assert launcher.poll({"session": SESSION}) is None
        assert launcher.running() == []
        launcher.stop({"session": SESSION}, timeout_s=1)
    assert listener.callers == 1
    with pytest.raises(LaunchError, match="did not answer a moment ago"):
        launcher.room()
    with pytest.raises(LaunchError, match="is not reached"):
        launcher.greet()  # a look at all hosts is made all the same
    assert listener.callers == 1
    now_s[0] = PAUSE_S
    assert launcher.poll({"session": SESSION}) is None
    assert listener.callers == 1
    web_bundle.cache_clear()


def test_its_sessions_have_addresses_of_its_relay():
    launcher = RelayedLauncher(HostAddress("robots.lan", 7164))
    assert launcher.address_of(SESSION, {"socket": "/elsewhere"}) == f"tls://robots.lan:7164/{SESSION}"
