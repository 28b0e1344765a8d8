"""Checks before every view."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from django.contrib.auth.models import AnonymousUser

from backend.accounts.models import User
from backend.accounts.permissions import AccountRequiredError, MayAsk, SignInRequiredError


def ask(user: Any, method: str = "GET", **view: Any) -> bool:
    request: Any = SimpleNamespace(user=user, method=method)
    asked: Any = SimpleNamespace(**view)
    return MayAsk().has_permission(request, asked)


def test_nobody_asks_nothing_and_a_user_anything() -> None:
    with pytest.raises(SignInRequiredError):
        ask(AnonymousUser())
    assert ask(User(pk=1, username="ada"), "DELETE")


def test_a_guest_reads_what_is_open(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(User, "is_guest", True)
    guest = User()
    assert ask(guest, kwargs={"project_id": 1})
    assert ask(guest, "POST", open_to_guests=True, guests_post=True)
    for refused in ({"method": "GET"}, {"method": "POST", "open_to_guests": True}):
        with pytest.raises(AccountRequiredError):
            ask(guest, **refused)
