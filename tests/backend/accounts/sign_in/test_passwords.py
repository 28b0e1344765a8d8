"""Links that set a new password."""

from __future__ import annotations

from backend.accounts.sign_in.passwords import link
from tests.backend.accounts.conftest import PUBLIC, Person


def test_the_link_opens_the_form_of_its_account(person):
    url = link(person("ada").user)
    assert url.startswith(f"http://{PUBLIC}/accounts/password/reset/key/")
    page = Person().client.get(url.partition(PUBLIC)[2], follow=True)
    assert page.status_code == 200
    assert b"password" in page.content
