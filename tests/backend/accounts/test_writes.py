"""Writes to accounts."""

from __future__ import annotations

import pytest

from backend.accounts.writes import (
    AccountTakenError,
    LastAdministratorError,
    an_administrator,
    create_account,
    delete_account,
    local_user,
    user_named,
)


def test_an_address_is_taken_once_whatever_its_case(team):
    made = create_account("ada", email="ada@example.org", password="Correct-horse-9")
    assert user_named("ada@example.org") == made == user_named("ada")
    with pytest.raises(AccountTakenError):
        create_account("bea", email="ADA@example.org", password="Correct-horse-9")


def test_the_last_administrator_stays(team):
    admin = create_account("root", email="", password="Correct-horse-9", is_admin=True)
    assert an_administrator() == admin
    with pytest.raises(LastAdministratorError):
        delete_account(admin)


def test_on_this_machine_there_is_one_user(db):
    assert local_user() == local_user()
