"""Accounts as tables."""

from __future__ import annotations

from backend.accounts.models import User


def test_an_account_that_was_never_stored_is_a_guests(person):
    assert not person("ada").user.is_guest
    assert User().is_guest
