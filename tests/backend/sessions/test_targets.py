"""Addresses of programs, as users write them."""

from __future__ import annotations

import pytest

from backend.sessions.errors import AddressError
from backend.sessions.targets import read_target


@pytest.mark.parametrize(
    ("text", "target"), [(" Robot.local ", "robot.local:1667"), ("[::1]:7", "[::1]:7"), ("tcp://a:1", "a:1")]
)
def test_an_address_is_written_in_one_way(text, target):
    assert read_target(text) == target


@pytest.mark.parametrize("text", ["ipc:///tmp/x", "inproc://x", "*:1667", "eth0;a:1", "", "a:70000"])
def test_other_addresses_are_refused_with_a_sentence(text):
    with pytest.raises(AddressError) as refused:
        read_target(text)
    assert refused.value.status == 400
    assert "HOST:PORT" in refused.value.detail
