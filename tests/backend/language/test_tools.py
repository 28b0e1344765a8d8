"""A user's tools are the same for every web server."""

from __future__ import annotations

from backend.accounts.models import User
from backend.language.tools import token, tools_id


def test_id_and_secret_follow_from_the_user():
    ada, bob = User(pk=1), User(pk=2)
    assert tools_id(ada) == tools_id(User(pk=1)) != tools_id(bob)
    assert token(tools_id(ada)) == token(tools_id(ada)) != token(tools_id(bob))
