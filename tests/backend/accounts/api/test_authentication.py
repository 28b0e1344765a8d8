"""The user of a request, for DRF."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from backend.accounts.api.authentication import GuardAuthentication


def test_a_session_is_its_user_and_no_session_is_nobody(person):
    ada = person("ada")
    cookies = {name: morsel.value for name, morsel in ada.client.cookies.items()}
    authentication: Any = GuardAuthentication()
    assert authentication.authenticate(SimpleNamespace(COOKIES=cookies)) == (ada.user, None)
    assert authentication.authenticate(SimpleNamespace(COOKIES={})) is None
    assert authentication.authenticate_header(SimpleNamespace()) == "Bearer"
