"""The one user of a server on localhost."""

from __future__ import annotations

from backend import __version__
from backend.accounts.models import User
from backend.accounts.writes import local_user


def test_the_local_user_is_made_once_and_has_no_password(db):
    first = local_user()
    assert local_user() == first
    assert User.objects.count() == 1
    assert not first.has_usable_password()


def test_the_page_learns_who_it_is_and_what_it_talks_to(api):
    found = api.get("me")
    assert (found["mode"], found["user"], found["role"]) == ("local", "local", "local")
    assert found["version"] == __version__
