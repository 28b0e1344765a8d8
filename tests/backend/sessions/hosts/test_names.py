"""Addresses of hosts."""

from __future__ import annotations

import pytest

from backend.sessions.hosts.names import HostAddress, read_host


@pytest.mark.parametrize(
    ("text", "host"),
    [
        ("robots.lan:7164", HostAddress("robots.lan", 7164)),
        ("10.0.0.3:99", HostAddress("10.0.0.3", 99)),
        ("[fd00::1]:7164", HostAddress("fd00::1", 7164)),
    ],
)
def test_an_address_is_read_and_written(text, host):
    assert read_host(text) == host
    assert str(host) == text
