"""Django's settings."""

from __future__ import annotations

from django.utils.module_loading import import_string

from backend.config import settings


def test_every_middleware_exists_for_both_kinds_of_server():
    for name in {*settings.MIDDLEWARE, *settings.TEAM_MIDDLEWARE}:
        assert import_string(name)


def test_a_team_has_addresses_of_its_own():
    assert settings.ROOT_URLCONF != settings.TEAM_URLS
    assert settings.SECRET_KEY
