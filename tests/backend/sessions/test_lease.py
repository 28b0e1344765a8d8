"""Work that one server does for all."""

from __future__ import annotations

import pytest

from backend.sessions.lease import Holder, is_alone


def test_a_server_that_is_alone_has_every_lease(db):
    if not is_alone():
        pytest.fail("this test is for one server")
    one, other = Holder(), Holder()
    assert one.name != other.name
    assert one.hold("care", 5.0)
    assert other.hold("care", 5.0)
    with one.chore("garbage", 60.0) as is_mine:
        assert is_mine


def test_what_fails_is_raised(db):
    with pytest.raises(ZeroDivisionError), Holder().chore("garbage", 60.0):
        raise ZeroDivisionError
