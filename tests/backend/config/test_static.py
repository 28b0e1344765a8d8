"""The built front end."""

from __future__ import annotations

from backend.config import static
from tests.backend.accounts.conftest import Person


def test_without_a_built_page_the_server_says_so(api, settings, tmp_path, monkeypatch):
    monkeypatch.setattr(type(settings.ENVIRONMENT), "frontend_dir", tmp_path, raising=False)
    page = api.client.get("/")
    assert page.status_code in {200, 503}
    assert static.page.__doc__


def test_on_a_team_server_a_stranger_signs_in_first(team):
    answer = Person().page("/projects/3f2504e0-4f89-41d3-9a0c-000000000001")
    assert answer.status_code == 302
    assert answer.headers["Location"].startswith("/accounts/login/?next=%2Fprojects")
